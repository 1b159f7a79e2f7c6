#include "tools/render/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace sediment::render {
namespace {

constexpr int kFine = 2;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kLargestDisc_px = 40;

View finer(View view) {
  view.size *= kFine;
  view.scale *= kFine;
  return view;
}

cv::Vec3b scaled(cv::Vec3b bgr, double factor) {
  for (int i = 0; i < 3; ++i) bgr[i] = cv::saturate_cast<std::uint8_t>(bgr[i] * factor);
  return bgr;
}

}  // namespace

Canvas::Canvas(const View& view)
    : view_(finer(view)),
      color_(view_.size, CV_8UC3, kPaper),
      depth_(view_.size, CV_32FC1, cv::Scalar(kFar)) {}

void Canvas::disc(Vec3 center, double radius_m, cv::Vec3b bgr) {
  const auto p = view_.project(center);
  if (!p) return;
  const float radius = std::clamp(static_cast<float>(radius_m) * p->px_per_metre, 0.71f, kLargestDisc_px);
  if (p->u < -radius || p->v < -radius || p->u > static_cast<float>(view_.size.width) + radius ||
      p->v > static_cast<float>(view_.size.height) + radius)
    return;
  const int left = std::max(0, static_cast<int>(std::ceil(p->u - radius))),
            top = std::max(0, static_cast<int>(std::ceil(p->v - radius)));
  const int right = std::min(view_.size.width - 1, static_cast<int>(std::floor(p->u + radius)));
  const int bottom = std::min(view_.size.height - 1, static_cast<int>(std::floor(p->v + radius)));
  for (int v = top; v <= bottom; ++v)
    for (int u = left; u <= right; ++u) {
      const float du = static_cast<float>(u) - p->u, dv = static_cast<float>(v) - p->v;
      float& depth = depth_.at<float>(v, u);
      if (du * du + dv * dv > radius * radius || p->depth_m >= depth) continue;
      depth = p->depth_m;
      color_.at<cv::Vec3b>(v, u) = bgr;
    }
}

void Canvas::triangle(const std::array<Projected, 3>& c, cv::Vec3b bgr) {
  const auto edge = [](const Projected& a, const Projected& b, float u, float v) {
    return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
  };
  const float area = edge(c[0], c[1], c[2].u, c[2].v);
  if (area == 0) return;
  const auto [low_u, high_u] = std::minmax({c[0].u, c[1].u, c[2].u});
  const auto [low_v, high_v] = std::minmax({c[0].v, c[1].v, c[2].v});
  const auto clipped = [](float value, int size) {
    return static_cast<int>(std::clamp(value, -1.0f, static_cast<float>(size)));
  };
  for (int v = std::max(0, clipped(std::ceil(low_v), view_.size.height));
       v <= std::min(view_.size.height - 1, clipped(std::floor(high_v), view_.size.height)); ++v)
    for (int u = std::max(0, clipped(std::ceil(low_u), view_.size.width));
         u <= std::min(view_.size.width - 1, clipped(std::floor(high_u), view_.size.width)); ++u) {
      const auto x = static_cast<float>(u), y = static_cast<float>(v);
      const float a = edge(c[1], c[2], x, y) / area, b = edge(c[2], c[0], x, y) / area, d = 1 - a - b;
      if (a < 0 || b < 0 || d < 0) continue;
      // In perspective the reciprocal of the depth is linear in the picture.
      const float depth_m = view_.perspective ? 1 / (a / c[0].depth_m + b / c[1].depth_m + d / c[2].depth_m)
                                              : a * c[0].depth_m + b * c[1].depth_m + d * c[2].depth_m;
      float& depth = depth_.at<float>(v, u);
      if (depth_m >= depth) continue;
      depth = depth_m;
      color_.at<cv::Vec3b>(v, u) = bgr;
    }
}

void Canvas::cube(Vec3 center, double side_m, cv::Vec3b bgr, Vec3 up) {
  const double h = side_m / 2;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      const Vec3 normal = sign * axes[axis], a = h * axes[(axis + 1) % 3], b = h * axes[(axis + 2) % 3];
      const Vec3 middle = center + h * normal;
      const Vec3 seen = view_.view_from_world * middle, facing = view_.view_from_world.rotate(normal);
      if (view_.perspective ? dot(seen, facing) >= 0 : facing.z >= 0) continue;  // turned away
      std::array<Projected, 4> corners;
      bool visible = true;
      int i = 0;
      for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        const auto p = view_.project(middle + static_cast<double>(s) * a + static_cast<double>(t) * b);
        visible = visible && p.has_value();
        corners[static_cast<std::size_t>(i++)] = p.value_or(Projected{});
      }
      if (!visible) continue;
      const double light = 0.74 + 0.26 * dot(normal, up) - 0.08 * std::abs(dot(normal, axes[0]));
      triangle({corners[0], corners[1], corners[2]}, scaled(bgr, light));
      triangle({corners[0], corners[2], corners[3]}, scaled(bgr, light));
    }
}

cv::Mat Canvas::shaded(double strength) const {
  cv::Mat lit = color_.clone();
  constexpr int kReach[2] = {2, 5};  // pixels of the fine picture
  const auto behind = [&](int v, int u, float depth_m) {
    if (u < 0 || v < 0 || u >= view_.size.width || v >= view_.size.height) return 0.0f;
    const float other_m = depth_.at<float>(v, u);
    return other_m < depth_m ? std::min(1.0f, (depth_m - other_m) / (0.02f * depth_m + 0.05f)) : 0.0f;
  };
  for (int v = 0; v < view_.size.height; ++v)
    for (int u = 0; u < view_.size.width; ++u) {
      const float depth_m = depth_.at<float>(v, u);
      if (depth_m == kFar) continue;
      float sum = 0;
      for (const int reach : kReach)
        for (const auto& [du, dv] :
             {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, 1}, {-1, 1}, {1, -1}})
          sum += behind(v + dv * reach, u + du * reach, depth_m);
      cv::Vec3b& pixel = lit.at<cv::Vec3b>(v, u);
      pixel = scaled(pixel, std::exp(-strength * sum / 16));
    }
  cv::Mat picture;
  cv::resize(lit, picture, view_.size / kFine, 0, 0, cv::INTER_AREA);
  return picture;
}

}  // namespace sediment::render
