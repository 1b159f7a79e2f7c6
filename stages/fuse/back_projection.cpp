#include "stages/fuse/back_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sediment::fuse {
namespace {

/// Label and colour of one instance id.
struct Paint {
  std::uint32_t label = kUnlabelled;
  std::array<std::uint8_t, 3> rgb{};
  int blend_256 = 0;  ///< share of rgb, in 1/256: whole numbers give the same bytes everywhere
};

void check_size(const char* what, const cv::Mat& image, const Camera& camera, bool may_be_empty) {
  if (may_be_empty && image.empty()) return;
  if (image.cols != camera.width || image.rows != camera.height)
    throw std::invalid_argument(std::string(what) + " is " + std::to_string(image.cols) + "x" +
                                std::to_string(image.rows) + ", the camera " + std::to_string(camera.width) +
                                "x" + std::to_string(camera.height));
}

/// Indexed by instance id; [0] is the background.
std::vector<Paint> paints_of(const InstanceMask& mask, const LabelTable& labels, double blend) {
  std::vector<Paint> paints(1);
  for (const Instance& instance : mask.instances) {
    if (paints.size() <= static_cast<std::size_t>(instance.id)) paints.resize(instance.id + 1);
    if (const Label* label = labels.find(instance.class_name))
      paints[instance.id] = {label->id, label->rgb, static_cast<int>(std::lround(blend * 256))};
  }
  return paints;
}

/// The range in units of the depth image, both ends included; 0 is no depth and never belongs to it.
std::pair<int, int> depth_units(const Projection& projection, double depth_scale) {
  const auto units = [&](double depth_m) { return std::clamp(depth_m * depth_scale, 0.0, 65535.0); };
  return {std::max(1, static_cast<int>(std::ceil(units(projection.min_depth_m)))),
          static_cast<int>(std::floor(units(projection.max_depth_m)))};
}

/// Tells pixels whose depth is a step (Projection::max_incidence_deg).
class StepFinder {
 public:
  StepFinder(const cv::Mat& depth, const Camera& camera, const Projection& projection)
      : depth_(depth), unit_m_(1 / camera.depth_scale), active_(projection.max_incidence_deg < 90) {
    // A surface at this angle gains so much depth from pixel to pixel, per metre of depth.
    slope_ = std::tan(projection.max_incidence_deg * std::numbers::pi / 180) / std::min(camera.fx, camera.fy);
    noise_ = 3 * std::numbers::sqrt2 * projection.noise;
  }

  bool is_step(int u, int v) const {
    if (!active_) return false;
    const auto* row = depth_.ptr<std::uint16_t>(v);
    const double z = row[u] * unit_m_, most = z * (slope_ + noise_ * z);
    const auto differs = [&](std::uint16_t neighbour) {
      return neighbour != 0 && std::abs(neighbour * unit_m_ - z) > most;
    };
    return (u > 0 && differs(row[u - 1])) || (u + 1 < depth_.cols && differs(row[u + 1])) ||
           (v > 0 && differs(depth_.at<std::uint16_t>(v - 1, u))) ||
           (v + 1 < depth_.rows && differs(depth_.at<std::uint16_t>(v + 1, u)));
  }

 private:
  const cv::Mat& depth_;
  double unit_m_, slope_ = 0, noise_ = 0;
  bool active_;
};

std::uint8_t mix(std::uint8_t image, std::uint8_t paint, int blend_256) {
  return static_cast<std::uint8_t>((image * (256 - blend_256) + paint * blend_256 + 128) >> 8);
}

LabelledPoint point_of(Vec3 position, const cv::Vec3b& bgr, const Paint& paint, std::uint32_t instance) {
  return {.x = static_cast<float>(position.x),
          .y = static_cast<float>(position.y),
          .z = static_cast<float>(position.z),
          .b = mix(bgr[0], paint.rgb[2], paint.blend_256),
          .g = mix(bgr[1], paint.rgb[1], paint.blend_256),
          .r = mix(bgr[2], paint.rgb[0], paint.blend_256),
          .label = paint.label,
          .instance = instance};
}

}  // namespace

PixelCounts& PixelCounts::operator+=(const PixelCounts& other) {
  visited += other.visited;
  dynamic += other.dynamic;
  out_of_range += other.out_of_range;
  at_edge += other.at_edge;
  return *this;
}

PixelCounts back_project(const View& view, const Camera& camera, std::span<const Ray> rays,
                         const LabelTable& labels, const Projection& projection, LabelledCloud& cloud) {
  check_size("the colour image", view.color, camera, false);
  check_size("the depth image", view.depth, camera, false);
  check_size("the instance mask", view.mask.ids, camera, true);
  check_size("the dynamic mask", view.dynamic, camera, true);

  const std::vector<Paint> paints = paints_of(view.mask, labels, projection.blend);
  const auto [nearest, farthest] = depth_units(projection, camera.depth_scale);
  const double unit_m = 1 / camera.depth_scale;
  const auto per_axis = [&](int pixels) {
    return static_cast<std::size_t>(1 + (pixels - 1) / projection.pixel_step);
  };
  cloud.reserve(cloud.size() + per_axis(camera.width) * per_axis(camera.height));
  const StepFinder steps(view.depth, camera, projection);
  PixelCounts counts;
  for (int v = 0; v < camera.height; v += projection.pixel_step) {
    const auto* color = view.color.ptr<cv::Vec3b>(v);
    const auto* depth = view.depth.ptr<std::uint16_t>(v);
    const auto* id = view.mask.ids.empty() ? nullptr : view.mask.ids.ptr<std::uint16_t>(v);
    const auto* dynamic = view.dynamic.empty() ? nullptr : view.dynamic.ptr<std::uint8_t>(v);
    const Ray* ray = rays.data() + static_cast<std::size_t>(v) * camera.width;
    for (int u = 0; u < camera.width; u += projection.pixel_step) {
      ++counts.visited;
      if (dynamic && dynamic[u] != kStatic) {
        ++counts.dynamic;
        continue;
      }
      if (depth[u] < nearest || depth[u] > farthest) {
        ++counts.out_of_range;
        continue;
      }
      if (steps.is_step(u, v)) {
        ++counts.at_edge;
        continue;
      }
      const double z = depth[u] * unit_m;
      const std::uint32_t instance = id ? id[u] : 0;
      cloud.push_back(point_of(view.world_from_camera * Vec3{ray[u].x * z, ray[u].y * z, z}, color[u],
                               instance < paints.size() ? paints[instance] : paints[0], instance));
    }
  }
  return counts;
}

}  // namespace sediment::fuse
