#include "pipeline/runner/store/receipt.hpp"

#include <stdexcept>

#include "pipeline/contract/digest.hpp"

namespace sediment::runner {
namespace {

using contract::Json;

constexpr const char* kReceiptFormat = "sediment-receipt 1";
constexpr std::string_view kDigestKey = ",\"digest\":\"";

}  // namespace

std::string text_of(const Receipt& receipt) {
  // All outputs of a stage lie in its one result folder, so that they share its id.
  Json outputs = Json::array();
  for (const Json& output : receipt.parts.at("outputs"))
    outputs.push_back({{"role", output.at(0)}, {"id", receipt.object}, {"bytes", receipt.bytes}});
  nlohmann::ordered_json json;
  json["format"] = kReceiptFormat;
  json["key"] = receipt.key;
  json["parts"] = receipt.parts;
  json["object"] = receipt.object;
  json["bytes"] = receipt.bytes;
  json["outputs"] = outputs;
  json["files"] = receipt.files;
  json["metrics"] = receipt.metrics;
  json["argv"] = receipt.argv;
  json["wall_s"] = receipt.wall_s;
  json["cpu_s"] = receipt.cpu_s;
  json["peak_bytes"] = receipt.peak_bytes;
  json["host"] = receipt.host;
  json["started"] = receipt.started;
  json["why"] = receipt.why;
  if (!receipt.accepted.is_null()) json["accepted"] = receipt.accepted;
  json["log"] = receipt.log;
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.pop_back();
  return text + std::string(kDigestKey) + contract::digest_bytes(text) + "\"}\n";
}

Receipt receipt_from(const std::string& text) {
  const std::size_t end = text.rfind(kDigestKey);
  if (end == std::string::npos ||
      text.substr(end) !=
          std::string(kDigestKey) + contract::digest_bytes(std::string_view(text).substr(0, end)) + "\"}\n")
    throw std::runtime_error("the receipt is cut or changed");
  const Json json = Json::parse(text);
  if (json.at("format") != kReceiptFormat)
    throw std::runtime_error("unknown format " + json.at("format").dump());
  Receipt receipt;
  receipt.key = json.at("key");
  receipt.parts = json.at("parts");
  receipt.object = json.at("object");
  receipt.bytes = json.at("bytes");
  receipt.files = json.at("files").get<decltype(receipt.files)>();
  receipt.metrics = json.at("metrics");
  receipt.argv = json.at("argv").get<std::vector<std::string>>();
  receipt.wall_s = json.at("wall_s");
  receipt.cpu_s = json.at("cpu_s");
  receipt.peak_bytes = json.at("peak_bytes");
  receipt.host = json.at("host");
  receipt.started = json.at("started");
  receipt.why = json.at("why");
  receipt.accepted = json.value("accepted", Json());
  receipt.log = json.at("log");
  return receipt;
}

}  // namespace sediment::runner
