#include "pipeline/runner/execution/workspace.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;

constexpr const char* kRunFormat = "sediment-run 1";
/// Stands within the first bytes of run.json.
constexpr std::string_view kIdKey = "\"id\": \"";

/// The target of a link in `folder`: relative if the folder lies beside the store or below that place (the
/// store of a sweep lies in the folder above that of the instance). Plain text: this runs for every instance
/// of every run.
std::string target_from(const std::string& folder, const std::string& object, const Store& store) {
  const std::string& root = store.root().native();
  const std::string above = root.substr(0, root.rfind('/') + 1);
  const std::string from = folder + '/';
  if (!from.starts_with(above)) return object;
  std::string target;
  for (std::size_t at = from.find('/', above.size()); at != from.npos; at = from.find('/', at + 1))
    target += "../";
  return target + object.substr(above.size());
}

std::string target_of(const fs::path& link) {
  char target[4096];
  const ssize_t count = readlink(link.c_str(), target, sizeof target);
  return count < 0 ? "" : std::string(target, static_cast<std::size_t>(count));
}

}  // namespace

void Workspace::check(const std::string& stage) const {
  const fs::path place = folder_ / stage;
  if (fs::symlink_status(place).type() == fs::file_type::not_found || fs::is_symlink(place)) return;
  throw contract::UsageError(place.string() +
                             " is no link of an earlier run: move it away or name another --out");
}

void Workspace::link(const std::string& stage, const std::string& object, const Store& store) const {
  const fs::path place = folder_ / stage;
  const std::string target =
      target_from(folder_.native(), store.root().native() + "/objects/" + object_name(object), store);
  if (target_of(place) == target) return;
  check(stage);
  fs::create_directories(folder_);
  const fs::path fresh = folder_ / ('.' + stage + ".link." + std::to_string(getpid()));
  fs::remove(fresh);
  fs::create_symlink(target, fresh);
  fs::rename(fresh, place);
}

RunRecord Workspace::read_record() const try {
  RunRecord record;
  std::ifstream stream(folder_ / "run.json");
  if (!stream) return record;
  const Json json = Json::parse(stream);
  if (json.at("format") != kRunFormat) return record;
  record.id = json.at("id");
  record.run = json.at("run");
  record.order = json.at("order").get<std::vector<std::string>>();
  for (const auto& [name, one] : json.at("stages").items())
    record.stages[name] = {one.at("key"), one.at("object"), one.at("state"), one.at("why"),
                           one.at("log"), one.at("wall_s"), one.at("bytes"), one.at("peak_bytes")};
  return record;
} catch (const std::exception&) {
  return {};
}

std::string Workspace::recorded() const {
  char begin[160];
  const int file = open((folder_.native() + "/run.json").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return "";
  const ssize_t count = read(file, begin, sizeof begin);
  close(file);
  const std::string_view text(begin, count < 0 ? 0 : static_cast<std::size_t>(count));
  const std::size_t id = text.find(kIdKey);
  const std::size_t end = id == text.npos ? id : text.find('"', id + kIdKey.size());
  return end == text.npos ? "" : std::string(text.substr(id + kIdKey.size(), end - id - kIdKey.size()));
}

void Workspace::write_record(const RunRecord& record) const {
  nlohmann::ordered_json json;
  json["format"] = kRunFormat;
  json["id"] = record.id;
  json["run"] = record.run;
  json["order"] = record.order;
  json["stages"] = nlohmann::ordered_json::object();
  for (const auto& [name, one] : record.stages)
    json["stages"][name] = {
        {"state", one.state}, {"key", one.key},       {"object", one.object}, {"why", one.why},
        {"log", one.log},     {"wall_s", one.wall_s}, {"bytes", one.bytes},   {"peak_bytes", one.peak_bytes}};
  fs::create_directories(folder_);
  const fs::path fresh = folder_ / (".run.json." + std::to_string(getpid()));
  std::ofstream stream(fresh, std::ios::binary);
  stream << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + fresh.string() + ": " + std::strerror(errno));
  fs::rename(fresh, folder_ / "run.json");
}

}  // namespace sediment::runner
