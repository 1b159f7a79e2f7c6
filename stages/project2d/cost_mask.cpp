#include "stages/project2d/cost_mask.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/yaml_fields.hpp"

namespace sediment::project2d {
namespace {

constexpr int kHighestCost = 100;

int checked_cost(const YamlFields& fields, const YAML::Node& node, const std::string& name) {
  int cost = -1;
  try {
    cost = node.as<int>();
  } catch (const YAML::Exception&) {
  }
  if (cost < 0 || cost > kHighestCost)
    fields.fail(node, "the cost of \"" + name + "\" must be a whole number from 0 to 100");
  return cost;
}

/// Costs by label id.
std::map<std::uint32_t, int> costs_by_id(const LabelTable& labels, const ClassCosts& costs) {
  std::map<std::uint32_t, int> by_id;
  for (const Label& label : labels.labels()) {
    const auto named = costs.of_class.find(label.name);
    by_id[label.id] = named == costs.of_class.end() ? costs.otherwise : named->second;
  }
  return by_id;
}

/// Every cell gets the highest cost of the cells within `reach`.
std::vector<std::uint8_t> widened(const GridMap& map, const std::vector<std::uint8_t>& mask, int reach) {
  std::vector<std::uint8_t> wide = mask;
  const auto known = [](std::uint8_t cost) { return cost == kNoCost ? -1 : static_cast<int>(cost); };
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      std::uint8_t& cost = wide[static_cast<std::size_t>(y) * map.width + x];
      for (int ny = std::max(0, y - reach); ny <= std::min(map.height - 1, y + reach); ++ny)
        for (int nx = std::max(0, x - reach); nx <= std::min(map.width - 1, x + reach); ++nx) {
          const std::uint8_t near = mask[static_cast<std::size_t>(ny) * map.width + nx];
          if (known(near) > std::max(0, known(cost))) cost = near;
        }
    }
  return wide;
}

}  // namespace

ClassCosts read_class_costs(const std::filesystem::path& file) {
  const YamlFields fields(file.string(), parse_yaml(read_bytes(file), file.string()),
                          {"costs", "default", "reach_cells"});
  ClassCosts costs;
  if (fields.has("default")) costs.otherwise = checked_cost(fields, fields.node("default"), "default");
  costs.reach_cells = fields.get<int>("reach_cells", 0);
  if (costs.reach_cells < 0 || costs.reach_cells > 100)
    fields.fail(fields.node("reach_cells"), "reach_cells must be from 0 to 100");
  const YAML::Node table = fields.node("costs");
  if (!table.IsDefined() || !table.IsMap()) fields.fail(table, "\"costs\" must map classes to costs");
  for (const auto& entry : table) {
    const auto name = entry.first.as<std::string>();
    if (!costs.of_class.emplace(name, checked_cost(fields, entry.second, name)).second)
      fields.fail(entry.first, "\"" + name + "\" is there twice");
  }
  return costs;
}

std::vector<std::uint8_t> cost_mask(const GridMap& map, const LabelledCloud& cloud, const LabelTable& labels,
                                    const ClassCosts& costs, double max_height_m, int min_points) {
  const std::map<std::uint32_t, int> cost_of = costs_by_id(labels, costs);
  std::map<std::pair<std::size_t, int>, int> points;  // of a cell with a cost
  for (const LabelledPoint& point : cloud) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) continue;
    const Vec3 p = map.map_from_world * Vec3{point.x, point.y, point.z};
    const double x = std::floor((p.x - map.origin_x_m) / map.resolution_m);
    const double y = std::floor((p.y - map.origin_y_m) / map.resolution_m);
    if (p.z > max_height_m || x < 0 || y < 0 || x >= map.width || y >= map.height) continue;
    const auto known = cost_of.find(point.label);
    ++points[{static_cast<std::size_t>(y) * map.width + static_cast<std::size_t>(x),
              known == cost_of.end() ? costs.otherwise : known->second}];
  }
  std::vector<std::uint8_t> mask(map.cells.size(), kNoCost);
  // In the order of the costs within a cell: the last one, the highest, stays.
  for (const auto& [cell_and_cost, count] : points)
    if (count >= min_points) mask[cell_and_cost.first] = static_cast<std::uint8_t>(cell_and_cost.second);
  return costs.reach_cells > 0 ? widened(map, mask, costs.reach_cells) : mask;
}

}  // namespace sediment::project2d
