#include "stages/carve/carve_sequence.hpp"

#include <stdexcept>

#include "pipeline/scene/frame_poses.hpp"

namespace sediment::carve {
namespace {

cv::Mat dynamic_of(const std::optional<DynamicMasksReader>& dynamic, const std::string& stamp,
                   const cv::Size& size) {
  if (!dynamic || !dynamic->has(stamp)) return {};
  cv::Mat mask = dynamic->read(stamp);
  if (mask.size() != size)
    throw std::runtime_error("dynamic mask of frame " + stamp + ": " + std::to_string(mask.cols) + " x " +
                             std::to_string(mask.rows) + " pixels, the depth image has " +
                             std::to_string(size.width) + " x " + std::to_string(size.height));
  return mask;
}

}  // namespace

Carved carve_cloud(const LabelledCloud& cloud, const Sequence& sequence, const Trajectory& trajectory,
                   const std::optional<DynamicMasksReader>& dynamic, int every_nth,
                   const Parameters& parameters, const std::function<void()>& advance) {
  Carved carved;
  const PointBlocks sorted = blocks_of(cloud);
  std::vector<Votes> votes(cloud.size());
  std::vector<FrameStamp> stamps;
  for (std::size_t idx = 0; idx < sequence.size(); ++idx)
    stamps.push_back({sequence.entry(idx).stamp, sequence.entry(idx).stamp_s});
  const FramePoses poses(stamps, trajectory);
  for (std::size_t idx = 0; idx < sequence.size(); idx += static_cast<std::size_t>(every_nth)) {
    const SequenceEntry& entry = sequence.entry(idx);
    if (const auto pose = poses.pose_of(stamps[idx])) {
      DepthView view{pose->inverse(), sequence.depth(idx), {}};
      view.dynamic = dynamic_of(dynamic, entry.stamp, view.depth.size());
      add_votes(sorted, sequence.camera(), view, parameters, votes);
      ++carved.statistics.views;
    } else {
      ++carved.statistics.frames_without_pose;
    }
    advance();
  }
  if (carved.statistics.views == 0)
    throw std::runtime_error(
        "no frame of the sequence has a pose in the trajectory: nothing can be seen through");
  std::vector<std::uint32_t> place(cloud.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[sorted.order[i]] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Votes& of = votes[place[i]];
    const bool goes = is_carved(of, parameters);
    if (goes)
      carved.removed.push_back(cloud[i]);
    else
      carved.kept.push_back(parameters.settle ? settled(cloud[i], of, parameters) : cloud[i]);
    carved.statistics.never_seen += of.through + of.hits == 0 ? 1 : 0;
    carved.statistics.spared += !goes && of.through > 0 ? 1 : 0;
  }
  return carved;
}

}  // namespace sediment::carve
