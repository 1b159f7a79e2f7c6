#include "stages/movers/sequence_views.hpp"

#include <algorithm>
#include <stdexcept>

namespace sediment::movers {
namespace {

std::vector<FrameStamp> stamps_of(const Sequence& sequence) {
  std::vector<FrameStamp> stamps;
  for (std::size_t i = 0; i < sequence.size(); ++i)
    stamps.push_back({sequence.entry(i).stamp, sequence.entry(i).stamp_s});
  return stamps;
}

}  // namespace

SequenceViews::SequenceViews(const Sequence& sequence, const DynamicMasksReader& dynamic,
                             const Trajectory& trajectory)
    : sequence_(sequence), dynamic_(dynamic), stamps_(stamps_of(sequence)), poses_(stamps_, trajectory) {}

/// From the poses of the frames before and after.
Speed SequenceViews::speed_of(std::size_t i) const {
  const std::size_t before = i - std::min<std::size_t>(i, 1), after = std::min(i + 1, stamps_.size() - 1);
  const auto from = poses_.pose_of(stamps_[before]), to = poses_.pose_of(stamps_[after]);
  const double seconds = stamps_[after].stamp_s - stamps_[before].stamp_s;
  if (!from || !to || !(seconds > 0)) return {};
  const Pose moved = from->inverse() * *to;
  return {norm(moved.translation) / seconds, rotation_angle(moved) / seconds};
}

View SequenceViews::read(std::size_t i) const {
  View view{
      stamps_[i].stamp_s, poses_.pose_of(stamps_[i]).value_or(Pose{}), speed_of(i), sequence_.depth(i), {}};
  const std::string& stamp = stamps_[i].stamp;
  view.dynamic =
      dynamic_.has(stamp) ? dynamic_.read(stamp) : cv::Mat(view.depth.size(), CV_8UC1, cv::Scalar(kStatic));
  if (view.dynamic.size() != view.depth.size())
    throw std::runtime_error("dynamic mask of frame " + stamp + ": " + std::to_string(view.dynamic.cols) +
                             " x " + std::to_string(view.dynamic.rows) + " pixels, the depth image has " +
                             std::to_string(view.depth.cols) + " x " + std::to_string(view.depth.rows));
  return view;
}

}  // namespace sediment::movers
