#include "tools/truth/true_sequence.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/sequence_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "tools/truth/ply_file.hpp"

namespace sediment::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kSameStamp_s = 1e-4, kLargestGap_s = 0.05;
constexpr std::uint32_t kCocoClasses = 80;

std::vector<std::optional<Pose>> poses_of(const Sequence& sequence, const Trajectory& truth) {
  std::vector<std::optional<Pose>> poses;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    const double stamp_s = sequence.entry(i).stamp_s;
    const auto exact = nearest_pose(truth, stamp_s, kSameStamp_s);
    poses.push_back(exact ? std::optional(truth[*exact].world_from_camera)
                          : pose_at(truth, stamp_s, kLargestGap_s));
  }
  return poses;
}

/// Brings labels of 100 and up to the default ones by their names; others and unknown names become other
/// furniture.
void translate_labels(LabelledCloud& cloud, const fs::path& instances_json) {
  if (!fs::exists(instances_json)) return;
  std::map<std::uint32_t, std::uint32_t> to;
  const std::uint32_t other = default_labels().find("other furniture")->id;
  try {
    const auto json = nlohmann::json::parse(read_bytes(instances_json));
    for (const auto& [id, name] : json.at("labels").items()) {
      const Label* label = default_labels().find(name.get<std::string>());
      to[static_cast<std::uint32_t>(std::stoul(id))] = label != nullptr ? label->id : other;
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(instances_json.string() + ": " + error.what());
  }
  for (LabelledPoint& point : cloud)
    if (point.label >= kCocoClasses && point.label != kUnlabelled) {
      const auto found = to.find(point.label);
      point.label = found == to.end() ? other : found->second;
    }
}

LabelledCloud read_static_cloud(const fs::path& truth) {
  if (fs::is_directory(truth / "static_cloud")) return read_cloud(truth / "static_cloud");
  if (!fs::exists(truth / "static_cloud.ply"))
    throw std::runtime_error(truth.string() + ": neither static_cloud/ nor static_cloud.ply is there");
  LabelledCloud cloud = read_ply(truth / "static_cloud.ply");
  translate_labels(cloud, truth / "instances.json");
  return cloud;
}

}  // namespace

TrueSequence open_true_sequence(const fs::path& path, const fs::path& given_truth) {
  Sequence sequence = Sequence::open(path);
  if (!sequence.groundtruth()) throw std::runtime_error(path.string() + ": names no groundtruth");
  const fs::path truth = given_truth.empty() ? read_sequence_file(path).root / "truth" : given_truth;
  auto poses = poses_of(sequence, read_ground_truth(*sequence.groundtruth()).trajectory);
  if (std::none_of(poses.begin(), poses.end(), [](const auto& pose) { return pose.has_value(); }))
    throw std::runtime_error(sequence.groundtruth()->string() + ": has no pose of any frame of " +
                             path.string());
  LabelledCloud cloud = read_static_cloud(truth);
  if (cloud.empty()) throw std::runtime_error(truth.string() + ": the static cloud is empty");
  return {std::move(sequence), std::move(poses), std::move(cloud), MaskFolder(truth / "dynamic"),
          InstanceTruth::beside(truth / "dynamic")};
}

bool is_cloud(const fs::path& path) {
  if (fs::is_directory(path)) return fs::exists(path / "cloud.pcd");
  return path.extension() == ".pcd" || path.extension() == ".ply";
}

LabelledCloud read_any_cloud(const fs::path& path) {
  if (fs::is_directory(path)) return read_cloud(path);
  return path.extension() == ".ply" ? read_ply(path) : read_pcd(path);
}

}  // namespace sediment::tools
