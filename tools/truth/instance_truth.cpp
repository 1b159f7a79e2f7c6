#include "tools/truth/instance_truth.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"

namespace sediment::tools {
namespace {

using Json = nlohmann::json;

void add(std::map<int, std::string>& classes, const Json& instance) {
  const int id = instance.at("id").get<int>();
  const auto name = instance.at("class").get<std::string>();
  const auto [place, fresh] = classes.emplace(id, name);
  if (!fresh && place->second != name)
    throw std::runtime_error("instance " + std::to_string(id) + " is a " + place->second + " and a " + name +
                             ": ids of the truth must stay the same through the sequence");
}

}  // namespace

InstanceTruth::InstanceTruth(const std::filesystem::path& folder)
    : images_(std::filesystem::is_directory(folder / "masks") ? folder / "masks" : folder) {
  const bool within = std::filesystem::exists(folder / "instances.json");
  const auto file = (within ? folder : folder.parent_path()) / "instances.json";
  try {
    const Json json = Json::parse(read_bytes(file));
    if (json.contains("frames")) {
      for (const Json& frame : json["frames"])
        for (const Json& instance : frame.at("instances")) add(classes_, instance);
    } else {
      for (const Json& instance : json.at("instances")) add(classes_, instance);
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::optional<InstanceTruth> InstanceTruth::beside(const std::filesystem::path& dynamic_masks) {
  const auto folder = std::filesystem::weakly_canonical(dynamic_masks).parent_path() / "instances";
  if (!std::filesystem::is_directory(folder)) return std::nullopt;
  return InstanceTruth(folder);
}

cv::Mat InstanceTruth::ids(const std::string& stamp) const {
  return read_gray16(images_ / (stamp + ".png"));
}

std::string InstanceTruth::class_of(int id) const {
  const auto found = classes_.find(id);
  return found == classes_.end() ? "" : found->second;
}

}  // namespace sediment::tools
