#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "tools/render/annotation.hpp"
#include "tools/render/canvas.hpp"
#include "tools/render/pictures.hpp"

namespace sediment::render {
namespace {

Vec3 position(const LabelledPoint& p) {
  return {p.x, p.y, p.z};
}

/// Finite points up to the height where the picture is cut open.
LabelledCloud visible_part(LabelledCloud cloud, const Pose& map_from_world, double max_height_m) {
  std::erase_if(cloud, [&](const LabelledPoint& p) {
    return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) ||
           (max_height_m > 0 && (map_from_world * position(p)).z > max_height_m);
  });
  return cloud;
}

/// Median distance to the nearest other point, from a few points.
double spacing_of(const LabelledCloud& cloud) {
  constexpr std::size_t kProbes = 60;
  std::vector<double> nearest;
  for (std::size_t probe = 0; probe < std::min(kProbes, cloud.size()); ++probe) {
    const std::size_t at = probe * cloud.size() / kProbes;
    double least = INFINITY;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3 d = position(cloud[i]) - position(cloud[at]);
      if (const double squared = dot(d, d); i != at && squared > 0) least = std::min(least, squared);
    }
    nearest.push_back(std::sqrt(least));
  }
  if (nearest.empty()) return 0.01;
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2),
                   nearest.end());
  const double median = nearest[nearest.size() / 2];
  return std::isfinite(median) ? median : 0.01;
}

std::vector<LegendEntry> legend_of(const LabelledCloud& cloud, const LabelTable& labels) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const LabelledPoint& p : cloud) ++counts[p.label];
  std::vector<std::pair<std::size_t, std::uint32_t>> order;
  for (const auto& [label, count] : counts) order.emplace_back(count, label);
  std::sort(order.rbegin(), order.rend());
  std::vector<LegendEntry> entries;
  for (const auto& [count, id] : order)
    if (const Label* label = labels.find(id))
      entries.push_back({{label->rgb[2], label->rgb[1], label->rgb[0]}, label->name});
  if (counts.contains(kUnlabelled)) entries.push_back({{150, 150, 150}, "unlabelled"});
  return entries;
}

struct Painted {
  std::vector<cv::Vec3b> bgr;
  HeightRange heights;
};

Painted paint(const LabelledCloud& cloud, const Pose& map_from_world, ColorBy by, const LabelTable& labels) {
  Painted painted;
  std::vector<double> heights_m;
  if (by == ColorBy::height) {
    for (const LabelledPoint& p : cloud) heights_m.push_back((map_from_world * position(p)).z);
    painted.heights = height_range(heights_m);
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const cv::Vec3b image{cloud[i].b, cloud[i].g, cloud[i].r};
    painted.bgr.push_back(by == ColorBy::image   ? image
                          : by == ColorBy::label ? label_color(cloud[i].label, image, labels)
                                                 : scale_color(painted.heights.share(heights_m[i])));
  }
  return painted;
}

}  // namespace

cv::Mat cloud_picture(const std::filesystem::path& path, const MapOptions& options) {
  const bool folder = std::filesystem::is_directory(path);
  const LabelTable own = folder ? read_cloud_labels(path) : LabelTable{};
  const LabelTable& labels = own.labels().empty() ? default_labels() : own;
  const Pose to_map = map_from_world(options.ground, options.up);
  const LabelledCloud cloud =
      visible_part(folder ? read_cloud(path) : read_pcd(path), to_map, options.max_height_m);

  std::vector<Vec3> points(cloud.size());
  std::transform(cloud.begin(), cloud.end(), points.begin(), position);
  const View view = fit_view(points, to_map, options.view);
  const Painted painted = paint(cloud, to_map, options.color, labels);
  const double radius_m = (options.point_size_m > 0 ? options.point_size_m : 1.7 * spacing_of(cloud)) / 2;
  Canvas canvas(view);
  for (std::size_t i = 0; i < points.size(); ++i) canvas.disc(points[i], radius_m, painted.bgr[i]);

  cv::Mat picture = canvas.shaded(options.shading);
  add_title(picture, options.title);
  if (!view.perspective) add_scale_bar(picture, view.scale);
  if (options.color == ColorBy::label) add_legend(picture, legend_of(cloud, labels));
  if (options.color == ColorBy::height) add_height_scale(picture, painted.heights);
  return picture;
}

}  // namespace sediment::render
