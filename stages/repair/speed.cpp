#include "stages/repair/speed.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::repair {
namespace {

constexpr int kCameraStep_px = 8, kObjectStep_px = 2;
constexpr std::size_t kFewestPixels = 30;
constexpr std::size_t kWindow = 2;  ///< frames on either side

/// The ray at a position between pixels, bilinear; none outside the image.
std::optional<Pixel> ray_at(const Camera& camera, const std::vector<Ray>& rays, cv::Point2f at) {
  if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(camera.width - 1) &&
        at.y < static_cast<float>(camera.height - 1)))
    return std::nullopt;
  const int left = static_cast<int>(at.x), top = static_cast<int>(at.y);
  const double right = at.x - left, low = at.y - top;
  const Ray* r = rays.data() + static_cast<std::size_t>(top) * camera.width + left;
  const auto mix = [&](auto of) {
    return (1 - low) * ((1 - right) * of(r[0]) + right * of(r[1])) +
           low * ((1 - right) * of(r[camera.width]) + right * of(r[camera.width + 1]));
  };
  return Pixel{mix([](const Ray& ray) { return ray.x; }), mix([](const Ray& ray) { return ray.y; })};
}

std::optional<SeenPoint> seen_point(const ClipFrame& frame, const ClipFrame& next, const Camera& camera,
                                    const std::vector<Ray>& rays, int u, int v) {
  const auto units = frame.depth.at<std::uint16_t>(v, u);
  if (units == 0) return std::nullopt;
  const cv::Point2f at(static_cast<float>(u), static_cast<float>(v));
  const cv::Point2f moved = frame.to_next.at(at.x, at.y), there = at + moved;
  const auto ray = ray_at(camera, rays, there);
  if (!ray || !is_mutual(moved, next.to_previous.at(there.x, there.y))) return std::nullopt;
  const double z = units / camera.depth_scale;
  const Ray& from = rays[static_cast<std::size_t>(v) * camera.width + u];
  return SeenPoint{{from.x * z, from.y * z, z}, *ray};
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::map<int, Displacement> displacements(const ClipFrame& frame, const ClipFrame& next,
                                          const InstanceMask& mask, const std::vector<int>& movers,
                                          const Camera& camera, const std::vector<Ray>& rays) {
  if (frame.to_next.empty()) return {};
  std::vector<SeenPoint> still;
  for (int v = kCameraStep_px / 2; v < camera.height; v += kCameraStep_px)
    for (int u = kCameraStep_px / 2; u < camera.width; u += kCameraStep_px) {
      if (std::find(movers.begin(), movers.end(), mask.ids.at<std::uint16_t>(v, u)) != movers.end()) continue;
      if (const auto seen = seen_point(frame, next, camera, rays, u, v)) still.push_back(*seen);
    }
  const double focal_px = (camera.fx + camera.fy) / 2;
  const auto motion = camera_motion(still, focal_px);
  if (!motion) return {};

  struct Samples {
    std::vector<double> x_m, y_m, z_m;
  };
  std::map<int, Samples> samples;
  for (int v = 0; v < camera.height; v += kObjectStep_px)
    for (int u = 0; u < camera.width; u += kObjectStep_px) {
      const int id = mask.ids.at<std::uint16_t>(v, u);
      if (id == 0) continue;
      const auto seen = seen_point(frame, next, camera, rays, u, v);
      if (!seen) continue;
      const Vec3 at_rest = motion->to_from * seen->point_m;
      if (at_rest.z <= 0) continue;
      samples[id].x_m.push_back(seen->ray.u * at_rest.z - at_rest.x);
      samples[id].y_m.push_back(seen->ray.v * at_rest.z - at_rest.y);
      samples[id].z_m.push_back(at_rest.z);
    }
  std::map<int, Displacement> moved;
  for (auto& [id, of] : samples)
    if (of.x_m.size() >= kFewestPixels)
      moved[id] = {median(of.x_m), median(of.y_m), next.stamp_s - frame.stamp_s,
                   motion->median_error_px / focal_px * median(of.z_m)};
  return moved;
}

std::map<std::size_t, double> speeds(const std::map<std::size_t, Displacement>& displacements) {
  std::map<std::size_t, double> speeds;
  for (const auto& [frame_idx, unused] : displacements) {
    Displacement sum;
    const auto end = displacements.upper_bound(frame_idx + kWindow);
    for (auto near = displacements.lower_bound(frame_idx > kWindow ? frame_idx - kWindow : 0); near != end;
         ++near) {
      sum.x_m += near->second.x_m;
      sum.y_m += near->second.y_m;
      sum.seconds += near->second.seconds;
      sum.error_m += near->second.error_m;
    }
    speeds[frame_idx] = std::max(0.0, std::hypot(sum.x_m, sum.y_m) - sum.error_m) / sum.seconds;
  }
  return speeds;
}

}  // namespace sediment::repair
