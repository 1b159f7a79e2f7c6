#include "tools/report/points_block.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::report {
namespace {

constexpr double kSteps = 65535;
constexpr std::size_t kMostLabels = 256;

/// Origin and step of one coordinate over all points.
struct Scale {
  double low = 0, step = 1e-6;

  Scale(const std::vector<ShownPoint>& points, double Vec3::*axis) {
    if (points.empty()) return;
    const auto [least, most] = std::minmax_element(
        points.begin(), points.end(),
        [&](const auto& a, const auto& b) { return a.position.*axis < b.position.*axis; });
    low = least->position.*axis;
    step = std::max((most->position.*axis - low) / kSteps, 1e-6);
  }
  void append(std::string& bytes, double value) const {
    const auto steps = static_cast<unsigned>(std::clamp(std::round((value - low) / step), 0.0, kSteps));
    bytes += static_cast<char>(steps & 255);
    bytes += static_cast<char>(steps >> 8);
  }
};

}  // namespace

PointsBlock pack(const std::vector<ShownPoint>& points, const LabelTable& labels) {
  const Scale x(points, &Vec3::x), y(points, &Vec3::y), z(points, &Vec3::z);
  std::map<std::uint32_t, std::size_t> counts;
  for (const ShownPoint& point : points) ++counts[point.label];
  std::vector<std::pair<std::size_t, std::uint32_t>> order;  // the most frequent first
  for (const auto& [label, count] : counts) order.emplace_back(count, label);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  if (order.size() > kMostLabels) order.resize(kMostLabels);
  std::map<std::uint32_t, unsigned> index_of;
  Json shown = Json::array();
  for (const auto& [count, id] : order) {
    const Label* label = labels.find(id);
    index_of[id] = static_cast<unsigned>(index_of.size());
    Json one = {{"name", id == kUnlabelled ? "unlabelled"
                         : label           ? label->name
                                           : "label " + std::to_string(id)},
                {"count", count}};
    if (label != nullptr && id != kUnlabelled) one["rgb"] = label->rgb;
    shown.push_back(std::move(one));
  }
  PointsBlock block;
  block.bytes.reserve(points.size() * 10);
  for (const ShownPoint& point : points) {
    x.append(block.bytes, point.position.x);
    y.append(block.bytes, point.position.y);
    z.append(block.bytes, point.position.z);
  }
  for (const ShownPoint& point : points)
    for (const std::uint8_t value : {point.r, point.g, point.b}) block.bytes += static_cast<char>(value);
  for (const ShownPoint& point : points) {
    const auto index = index_of.find(point.label);
    block.bytes += static_cast<char>(index == index_of.end() ? 0 : index->second);
  }
  block.facts = {{"count", points.size()},
                 {"origin", {x.low, y.low, z.low}},
                 {"step", {x.step, y.step, z.step}},
                 {"labels", shown}};
  return block;
}

}  // namespace sediment::report
