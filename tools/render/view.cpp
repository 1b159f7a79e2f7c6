#include "tools/render/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace sediment::render {
namespace {

constexpr double kNearest_m = 0.05;
/// Share of the points that may fall outside the picture on each side.
constexpr double kOutside = 0.002;
constexpr double kObliqueFieldOfView_deg = 35;
constexpr double kBorder = 0.04;  // of the picture's size

double radians(double deg) {
  return deg * std::numbers::pi / 180;
}

/// Rounded outwards: of few values the outermost.
double quantile(std::vector<double> values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share < 0.5 ? std::floor(place) : std::ceil(place));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

struct Interval {
  double low = 0, high = 0;
  double middle() const { return (low + high) / 2; }
  double length() const { return std::max(high - low, 0.1); }
};

/// The points along one axis of the view, without the farthest ones.
Interval interval_of(const std::vector<Vec3>& points, double Vec3::*axis) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Vec3& p : points) values.push_back(p.*axis);
  return {quantile(values, kOutside), quantile(values, 1 - kOutside)};
}

/// Optical axes that look along `ahead`, with `up` towards the top of the picture; directions in the map
/// frame.
Pose looking(Vec3 ahead, Vec3 up) {
  const Vec3 z = normalized(ahead), x = normalized(cross(z, up)), y = cross(z, x);
  return {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, {}};
}

std::vector<Vec3> transformed(std::span<const Vec3> points, const Pose& pose) {
  std::vector<Vec3> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(), [&](Vec3 p) { return pose * p; });
  return result;
}

View parallel_view(const std::vector<Vec3>& points, const Pose& turned_from_world,
                   const ViewOptions& options) {
  const Interval x = interval_of(points, &Vec3::x), y = interval_of(points, &Vec3::y),
                 z = interval_of(points, &Vec3::z);
  View view{turned_from_world, false, 1, options.size};
  view.scale = options.zoom * (1 - 2 * kBorder) *
               std::min(options.size.width / x.length(), options.size.height / y.length());
  view.view_from_world.translation =
      view.view_from_world.translation - Vec3{x.middle(), y.middle(), z.low - 1};
  return view;
}

/// As near as possible with all points inside: the camera steps back along its axis until each one is.
View perspective_view(std::vector<Vec3> points, const Pose& turned_from_world, const ViewOptions& options) {
  const double focal_px = 0.5 * options.size.width / std::tan(radians(kObliqueFieldOfView_deg) / 2);
  const double right = (0.5 - kBorder) * options.size.width / focal_px,
               bottom = (0.5 - kBorder) * options.size.height / focal_px;
  const Interval x = interval_of(points, &Vec3::x), y = interval_of(points, &Vec3::y),
                 z = interval_of(points, &Vec3::z);
  const Vec3 middle{x.middle(), y.middle(), z.middle()};
  std::vector<double> back_m;
  for (const Vec3 p : points) {
    const Vec3 d = p - middle;
    back_m.push_back(std::max(std::abs(d.x) / right, std::abs(d.y) / bottom) - d.z);
  }
  View view{turned_from_world, true, focal_px, options.size};
  view.view_from_world.translation =
      view.view_from_world.translation - middle + Vec3{0, 0, quantile(back_m, 1 - kOutside) / options.zoom};
  return view;
}

Pose pose_from_rows(const std::array<std::array<double, 4>, 4>& rows) {
  Pose pose;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) pose.rotation[3 * row + column] = rows[row][column];
  pose.translation = {rows[0][3], rows[1][3], rows[2][3]};
  return pose;
}

}  // namespace

std::optional<Projected> View::project(Vec3 point) const {
  const Vec3 p = view_from_world * point;
  if (perspective && !(p.z > kNearest_m)) return std::nullopt;
  const double s = perspective ? scale / p.z : scale;
  return Projected{static_cast<float>(size.width / 2.0 + s * p.x),
                   static_cast<float>(size.height / 2.0 + s * p.y), static_cast<float>(p.z),
                   static_cast<float>(s)};
}

View fit_view(std::span<const Vec3> points, const Pose& map_from_world, const ViewOptions& options) {
  if (options.direction == Direction::pose) {
    const double focal_px = 0.5 * options.size.width / std::tan(radians(options.field_of_view_deg) / 2);
    return {options.world_from_camera.inverse(), true, focal_px * options.zoom, options.size};
  }
  if (points.empty()) return {map_from_world, false, 100, options.size};
  const double azimuth = radians(options.azimuth_deg), elevation = radians(options.elevation_deg);
  const bool top = options.direction == Direction::top;
  const Vec3 ahead{std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                   -std::sin(elevation)};
  const Pose turned = (top ? looking({0, 0, -1}, {0, 1, 0}) : looking(ahead, {0, 0, 1})) * map_from_world;
  std::vector<Vec3> in_view = transformed(points, turned);
  return top ? parallel_view(in_view, turned, options)
             : perspective_view(std::move(in_view), turned, options);
}

Pose map_from_world(const std::string& ground, const std::string& up) {
  if (!ground.empty()) {
    std::filesystem::path file = ground;
    if (std::filesystem::is_directory(file)) file /= "ground.json";
    try {
      std::ifstream stream(file);
      if (!stream) throw std::runtime_error("cannot be read");
      return pose_from_rows(
          nlohmann::json::parse(stream).at("map_from_world").get<std::array<std::array<double, 4>, 4>>());
    } catch (const std::exception& error) {
      throw std::runtime_error(file.string() + ": " + error.what());
    }
  }
  Vec3 z{0, -1, 0};
  if (!up.empty()) {
    std::istringstream words(up);
    std::string more;
    if (!(words >> z.x >> z.y >> z.z) || words >> more || !(norm(z) > 0))
      throw std::runtime_error("--up: expected \"x y z\", found \"" + up + "\"");
    z = normalized(z);
  }
  const Vec3 axis = std::abs(z.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 x = normalized(axis - dot(axis, z) * z), y = cross(z, x);
  return {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, {}};
}

}  // namespace sediment::render
