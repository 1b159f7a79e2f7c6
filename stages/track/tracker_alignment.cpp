// The part of the tracker that aligns whole images.
#include "stages/track/tracker.hpp"

namespace sediment::track {
namespace {

constexpr double kLeastOverlap = 0.4;     // of an alignment of whole images
constexpr double kWorstDeviation = 0.02;  // radians, metres
constexpr std::size_t kKeptImages = 4;

}  // namespace

// The frame as a whole against the last one: survives fast turns and blur, where features do not.
std::optional<Pose> Tracker::aligned_to_last(const Pose& predicted) {
  const Pose last = camera_from_world(frames_[last_tracked_], map_);
  const DenseAlignment alignment = align(last_images(), current_images(), dense_camera_,
                                         predicted * last.inverse(), 1, parameters_.depth_noise);
  if (alignment.overlap < kLeastOverlap || worst_deviation(alignment) > kWorstDeviation) return {};
  return alignment.current_from_reference * last;
}

const DenseImages& Tracker::current_images() {
  if (!images_)
    images_ = std::make_shared<const DenseImages>(
        dense_images(*frames_.back().dense, dense_camera_, parameters_.depth_noise));
  return *images_;
}

const DenseImages& Tracker::last_images() {
  if (!last_images_)
    last_images_ = std::make_shared<const DenseImages>(
        dense_images(*frames_[last_tracked_].dense, dense_camera_, parameters_.depth_noise));
  return *last_images_;
}

const DenseImages& Tracker::images_of(int keyframe_idx) {
  const auto found = keyframe_images_.find(keyframe_idx);
  if (found != keyframe_images_.end()) return found->second;
  if (keyframe_images_.size() >= kKeptImages) keyframe_images_.erase(keyframe_images_.begin());
  return keyframe_images_[keyframe_idx] =
             dense_images(*map_.keyframes[keyframe_idx].dense, dense_camera_, parameters_.depth_noise);
}

// Where features fail: the frame as a whole against its keyframe, which does not drift while that one is in
// view.
std::optional<Tracker::Found> Tracker::align_to_keyframe(const Pose& predicted) {
  const int keyframe_idx = frames_[last_tracked_].reference_idx;
  const Pose& world_from_keyframe = map_.keyframes[keyframe_idx].world_from_camera;
  const DenseAlignment alignment = align(images_of(keyframe_idx), current_images(), dense_camera_,
                                         predicted * world_from_keyframe, 0, parameters_.depth_noise);
  if (alignment.overlap < kLeastOverlap || worst_deviation(alignment) > kWorstDeviation) return {};
  frames_.back().reference_idx = keyframe_idx;
  Found found;
  found.estimate.camera_from_world = alignment.current_from_reference * world_from_keyframe.inverse();
  return found;
}

void Tracker::link(int from_idx, int to_idx) {
  const Pose start =
      map_.keyframes[to_idx].world_from_camera.inverse() * map_.keyframes[from_idx].world_from_camera;
  const DenseAlignment alignment =
      align(images_of(from_idx), current_images(), dense_camera_, start, 0, parameters_.depth_noise);
  if (alignment.overlap < kLeastOverlap) return;
  map_.links.push_back({from_idx, to_idx, alignment.current_from_reference, alignment.information});
}

}  // namespace sediment::track
