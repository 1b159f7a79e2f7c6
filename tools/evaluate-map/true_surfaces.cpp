#include "tools/evaluate-map/true_surfaces.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/scene/frame.hpp"

namespace sediment::tools {
namespace {

constexpr double kCell_m = 0.01;

/// Ids of objects that are moved at some time (value 2). People never rest for a map.
std::set<int> moved_instances(const TrueSequence& truth) {
  std::set<int> moved;
  if (!truth.instances) return moved;
  for (std::size_t i = 0; i < truth.sequence.size(); ++i) {
    const std::string& stamp = truth.sequence.entry(i).stamp;
    if (!truth.dynamic.has(stamp)) continue;
    const cv::Mat dynamic = truth.dynamic.dynamic(stamp), ids = truth.instances->ids(stamp);
    for (int y = 0; y < dynamic.rows; ++y)
      for (int x = 0; x < dynamic.cols; ++x)
        if (dynamic.at<std::uint8_t>(y, x) == kNonPriorDynamic) moved.insert(ids.at<std::uint16_t>(y, x));
  }
  moved.erase(0);
  return moved;
}

MoverPoints points_of_frame(const TrueSequence& truth, std::size_t frame_idx, const std::vector<Ray>& rays,
                            const std::set<int>& moved, double max_depth_m, int pixel_step) {
  MoverPoints points;
  const std::string& stamp = truth.sequence.entry(frame_idx).stamp;
  const auto& pose = truth.world_from_camera[frame_idx];
  if (!pose || !truth.dynamic.has(stamp)) return points;
  const cv::Mat dynamic = truth.dynamic.dynamic(stamp), depth = truth.sequence.depth(frame_idx);
  const cv::Mat ids = moved.empty() ? cv::Mat() : truth.instances->ids(stamp);
  if (dynamic.size() != depth.size())
    throw std::runtime_error("frame " + stamp +
                             ": the true dynamic mask has another size than the depth image");
  for (int y = 0; y < depth.rows; y += pixel_step)
    for (int x = 0; x < depth.cols; x += pixel_step) {
      const double z = depth.at<std::uint16_t>(y, x) / truth.sequence.camera().depth_scale;
      if (z <= 0 || z > max_depth_m) continue;
      const bool moves = dynamic.at<std::uint8_t>(y, x) != 0;
      const bool rests = !moves && !ids.empty() && moved.contains(ids.at<std::uint16_t>(y, x));
      if (!moves && !rests) continue;
      const Ray ray = rays[static_cast<std::size_t>(y) * depth.cols + x];
      (moves ? points.dynamic : points.resting).push_back(*pose * Vec3{ray.x * z, ray.y * z, z});
    }
  return points;
}

/// Appends the points whose cell has none yet.
void append(std::vector<Vec3>& to, const std::vector<Vec3>& from, VoxelSet& seen) {
  for (const Vec3& point : from) {
    const Voxel voxel = seen.voxel_of(point);
    if (seen.contains(voxel)) continue;
    seen.insert(voxel);
    to.push_back(point);
  }
}

}  // namespace

MoverPoints mover_points(const TrueSequence& truth, double max_depth_m, int pixel_step) {
  const std::set<int> moved = moved_instances(truth);
  const std::vector<Ray> rays = rays_of(truth.sequence.camera());
  std::vector<MoverPoints> by_frame(truth.sequence.size());
  tbb::parallel_for(std::size_t{0}, by_frame.size(), [&](std::size_t i) {
    by_frame[i] = points_of_frame(truth, i, rays, moved, max_depth_m, pixel_step);
  });
  MoverPoints points;
  VoxelSet dynamic(kCell_m), resting(kCell_m);
  for (const MoverPoints& of_frame : by_frame) {
    append(points.dynamic, of_frame.dynamic, dynamic);
    append(points.resting, of_frame.resting, resting);
  }
  return points;
}

TrueVoxels true_voxels(const LabelledCloud& static_cloud, const MoverPoints& movers, double side_m) {
  TrueVoxels voxels{VoxelSet(side_m), VoxelSet(side_m), VoxelSet(side_m)};
  for (const LabelledPoint& point : static_cloud) voxels.still.insert(Vec3{point.x, point.y, point.z});
  voxels.surface = voxels.still;
  for (const Vec3& point : movers.resting) voxels.surface.insert(point);
  VoxelSet hit(side_m);
  for (const Vec3& point : movers.dynamic) hit.insert(point);
  for (const Voxel voxel : hit.sorted())
    if (!voxels.surface.contains_near(voxel)) voxels.dynamic.insert(voxel);
  return voxels;
}

FreeSpace::FreeSpace(const TrueSequence& truth, double voxel_side_m, int least_frames, std::size_t max_frames)
    : camera_(truth.sequence.camera()), margin_m_(voxel_side_m), least_frames_(least_frames) {
  std::vector<std::size_t> posed;
  for (std::size_t i = 0; i < truth.sequence.size(); ++i)
    if (truth.world_from_camera[i]) posed.push_back(i);
  const std::size_t count = std::min(max_frames, posed.size());
  views_.resize(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    const std::size_t i = posed[k * posed.size() / count];
    views_[k] = {truth.world_from_camera[i]->inverse(), truth.sequence.depth(i)};
  });
}

std::vector<Vec3> FreeSpace::viewpoints() const {
  std::vector<Vec3> points;
  for (const View& view : views_) points.push_back(view.camera_from_world.inverse().translation);
  return points;
}

bool FreeSpace::contains(Vec3 point) const {
  int seen_through = 0;
  for (const View& view : views_) {
    const Vec3 at = view.camera_from_world * point;
    if (at.z < 0.1) continue;
    const Pixel pixel = camera_.project(at);
    const auto u = std::lround(pixel.u), v = std::lround(pixel.v);
    if (u < 0 || v < 0 || u >= camera_.width || v >= camera_.height) continue;
    const double depth_m =
        view.depth.at<std::uint16_t>(static_cast<int>(v), static_cast<int>(u)) / camera_.depth_scale;
    // Depth noise of structured light: about 1.5 mm z^2; three times that.
    if (depth_m > at.z + margin_m_ + 0.0045 * depth_m * depth_m && ++seen_through >= least_frames_)
      return true;
  }
  return false;
}

}  // namespace sediment::tools
