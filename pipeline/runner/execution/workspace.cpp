#include "pipeline/runner/execution/workspace.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "pipeline/contract/digest.hpp"
#include "pipeline/contract/errors.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;

constexpr const char* kFormat = "sediment-run 1";

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
  const fs::path absolute = store.object_path(object);
  const bool inside = store.root().native().starts_with(folder_.native() + '/');
  const std::string target =
      inside ? absolute.native().substr(folder_.native().size() + 1) : absolute.native();
  if (target_of(place) == target) return;
  fs::create_directories(folder_);
  const fs::path fresh = folder_ / ('.' + stage + ".link." + std::to_string(getpid()));
  fs::remove(fresh);
  fs::create_symlink(target, fresh);
  fs::rename(fresh, place);
}

std::map<std::string, StageRecord> Workspace::read_record() const try {
  std::map<std::string, StageRecord> stages;
  std::ifstream stream(folder_ / "run.json");
  if (!stream) return stages;
  const Json json = Json::parse(stream);
  if (json.at("format") != kFormat) return stages;
  for (const auto& [name, one] : json.at("stages").items())
    stages[name] = {one.at("key"), one.at("object"), one.at("state"), one.at("why"),
                    one.at("log"), one.at("wall_s"), one.at("bytes"), one.at("peak_bytes")};
  return stages;
} catch (const std::exception&) {
  return {};  // the record explains; nothing depends on it
}

void Workspace::write_record(const std::map<std::string, StageRecord>& stages) const {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["stages"] = nlohmann::ordered_json::object();
  for (const auto& [name, one] : stages)
    json["stages"][name] = {
        {"state", one.state}, {"key", one.key},       {"object", one.object}, {"why", one.why},
        {"log", one.log},     {"wall_s", one.wall_s}, {"bytes", one.bytes},   {"peak_bytes", one.peak_bytes}};
  fs::create_directories(folder_);
  const fs::path fresh = folder_ / (".run.json." + std::to_string(getpid()));
  std::ofstream stream(fresh, std::ios::binary);
  stream << json.dump(1) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + fresh.string() + ": " + std::strerror(errno));
  fs::rename(fresh, folder_ / "run.json");
}

}  // namespace sediment::runner
