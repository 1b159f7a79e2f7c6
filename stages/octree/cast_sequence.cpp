#include "stages/octree/cast_sequence.hpp"

#include <tbb/parallel_pipeline.h>

#include <stdexcept>
#include <vector>

#include "pipeline/scene/frame_poses.hpp"

namespace sediment::octree {
namespace {

struct PosedFrame {
  std::size_t frame_idx = 0;
  Pose world_from_camera;
};

std::vector<PosedFrame> posed_frames(const Sequence& sequence, const Trajectory& trajectory, int every_nth,
                                     CastCounts& counts) {
  std::vector<FrameStamp> stamps;
  for (std::size_t i = 0; i < sequence.size(); ++i)
    stamps.push_back({sequence.entry(i).stamp, sequence.entry(i).stamp_s});
  const FramePoses poses(stamps, trajectory);
  std::vector<PosedFrame> frames;
  for (std::size_t i = 0; i < stamps.size(); i += static_cast<std::size_t>(every_nth)) {
    if (const auto pose = poses.pose_of(stamps[i]))
      frames.push_back({i, *pose});
    else
      ++counts.frames_without_pose;
  }
  counts.frames = frames.size();
  if (frames.empty())
    throw std::runtime_error("no frame of the sequence has a pose in the trajectory: no ray can be cast");
  return frames;
}

void check_size(const cv::Mat& image, const Camera& camera) {
  if (image.empty() || (image.cols == camera.width && image.rows == camera.height)) return;
  throw std::runtime_error("the dynamic mask has " + std::to_string(image.cols) + " x " +
                           std::to_string(image.rows) + " pixels, the camera " +
                           std::to_string(camera.width) + " x " + std::to_string(camera.height));
}

}  // namespace

CastCounts cast_sequence(const Sequence& sequence, const Trajectory& trajectory,
                         const std::optional<DynamicMasksReader>& dynamic, int every_nth,
                         const RayParameters& parameters, double resolution_m, std::size_t frames_in_flight,
                         const std::function<void()>& advance, RayMap& map) {
  CastCounts counts;
  const std::vector<PosedFrame> frames = posed_frames(sequence, trajectory, every_nth, counts);
  const std::vector<Ray> rays = rays_of(sequence.camera());
  const auto cast = [&](const PosedFrame& frame) {
    const std::string& stamp = sequence.entry(frame.frame_idx).stamp;
    try {
      const DepthView view{frame.world_from_camera, sequence.depth(frame.frame_idx),
                           dynamic ? dynamic->read(stamp) : cv::Mat{}};
      check_size(view.dynamic, sequence.camera());
      return cells_of_rays(frame.world_from_camera.translation,
                           ray_ends(view, sequence.camera(), rays, parameters, resolution_m), resolution_m);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("frame " + stamp + ": " + error.what());
    }
  };

  std::size_t next = 0;
  const auto number =
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        if (next == frames.size()) flow.stop();
        return next++;
      });
  const auto cast_one = tbb::make_filter<std::size_t, std::vector<Brick>>(
      tbb::filter_mode::parallel, [&](std::size_t i) { return cast(frames[i]); });
  const auto add = tbb::make_filter<std::vector<Brick>, void>(tbb::filter_mode::serial_in_order,
                                                              [&](const std::vector<Brick>& cells) {
                                                                map.add(cells);
                                                                advance();
                                                              });
  tbb::parallel_pipeline(frames_in_flight, number & cast_one & add);
  return counts;
}

}  // namespace sediment::octree
