#include "tools/tabulate/paper_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "tools/tabulate/map_sizes.hpp"
#include "tools/tabulate/paper_figures.hpp"

namespace sediment::tabulate {
namespace {

constexpr double kMegabyte = 1e6;
/// A ratio reproduces that of the paper if it is this near.
constexpr double kAgreement = 0.03;

Cell megabytes(double bytes) {
  return shown(bytes, 2, 1 / kMegabyte);
}
Cell percents(double share) {
  return shown(share, 1, 100);
}
std::string name_of(const MapSizes& sizes) {
  if (const PaperSequence* paper = paper_sequence(sizes.sequence)) return paper->shown;
  constexpr std::string_view kPrefix = "rgbd_dataset_";
  return sizes.sequence.starts_with(kPrefix) ? sizes.sequence.substr(kPrefix.size()) : sizes.sequence;
}

Table size_table(const std::vector<MapSizes>& all) {
  Table table{{"sequence", "frames fused", "dense [MB]", "points", "+ SOR [MB]", "+ voxel [MB]",
               "points left", "left [%]", "map.ot [MB]", "of dense [%]", "map.bt [MB]", "paper: dense [MB]",
               "paper: reduced [MB]", "paper: left [%]"},
              {}};
  for (const MapSizes& one : all) {
    const PaperSequence* paper = paper_sequence(one.sequence);
    table.rows.push_back({{name_of(one)},
                          shown(one.frames_fused, 0),
                          megabytes(one.dense),
                          shown(one.dense_points, 0),
                          megabytes(one.after_sor),
                          megabytes(one.after_voxel),
                          shown(one.voxel_points, 0),
                          percents(one.reduced()),
                          megabytes(one.tree),
                          percents(one.tree / one.dense),
                          shown(one.tree_binary, 3, 1 / kMegabyte),
                          shown(paper ? paper->dense_mb : std::nullopt, 1),
                          shown(paper ? paper->reduced_mb : std::nullopt, 1),
                          shown(paper ? paper->ratio() : std::nullopt, 1, 100)});
  }
  return table;
}

Table sor_table(const std::vector<MapSizes>& all) {
  Table table{{"sequence", "points", "removed", "removed [%]"}, {}};
  std::vector<double> shares;
  for (const MapSizes& one : all) {
    shares.push_back(one.removed_by_sor());
    table.rows.push_back({{name_of(one)},
                          shown(one.dense_points, 0),
                          shown(one.dense_points - one.sor_points, 0),
                          shown(one.removed_by_sor(), 2, 100)});
  }
  table.rows.push_back({{"median"}, {"-"}, {"-"}, shown(median(shares), 2, 100)});
  table.rows.push_back({{"paper"}, {"-"}, {"-"}, shown(PaperBands{}.sor_removed, 2, 100)});
  return table;
}

/// What a band shows: which rows and columns it has, the ratio of an instance, and whether it is the paper's.
struct Band {
  std::vector<std::string> headings;
  std::function<std::vector<std::string>(const MapSizes&)> row;
  std::function<double(const MapSizes&)> column, ratio;
  std::function<bool(const MapSizes&)> agrees;
  std::string unit;
};

/// The rows of every sequence, then the median over the sequences. What agrees with the paper is set in bold.
Table band_table(const std::vector<MapSizes>& all, const Band& band) {
  std::set<double> columns;
  std::vector<std::vector<std::string>> order;
  std::map<std::vector<std::string>, std::map<double, const MapSizes*>> rows;
  std::map<std::vector<std::string>, std::map<double, std::vector<double>>> together;
  for (const MapSizes& one : all) {
    const auto row = band.row(one);
    const double column = band.column(one);
    columns.insert(column);
    if (!rows.contains(row)) order.push_back(row);
    if (rows[row].contains(column)) continue;
    rows[row][column] = &one;
    together[{row.begin() + 1, row.end()}][column].push_back(band.ratio(one));
  }
  std::map<std::string, std::size_t> place;  // sequences as they come, what belongs to one together
  for (const auto& row : order) place.try_emplace(row.front(), place.size());
  std::sort(order.begin(), order.end(), [&](const auto& x, const auto& y) {
    return std::pair(place[x.front()], x) < std::pair(place[y.front()], y);
  });
  Table table{band.headings, {}};
  for (const double column : columns) table.headings.push_back(formatted("%g %s", column, band.unit.c_str()));
  for (const auto& row : order) {
    std::vector<Cell> cells;
    for (const std::string& text : row) cells.push_back({text});
    for (const double column : columns) {
      Cell cell{"-"};
      if (rows[row].contains(column)) {
        cell = percents(band.ratio(*rows[row][column]));
        if (band.agrees(*rows[row][column])) cell.text = "**" + cell.text + "**";
      }
      cells.push_back(cell);
    }
    table.rows.push_back(std::move(cells));
  }
  for (const auto& [rest, ratios] : together) {
    std::vector<Cell> cells{{"median"}};
    for (const std::string& text : rest) cells.push_back({text});
    for (const double column : columns)
      cells.push_back(ratios.contains(column) ? percents(*median(ratios.at(column))) : Cell{"-"});
    table.rows.push_back(std::move(cells));
  }
  return table;
}

bool agrees_in_size(const MapSizes& one) {
  const PaperSequence* paper = paper_sequence(one.sequence);
  const PaperBands bands;
  if (paper != nullptr && paper->ratio()) return std::abs(one.reduced() - *paper->ratio()) <= kAgreement;
  return one.reduced() >= bands.reduced_low && one.reduced() <= bands.reduced_high;
}

bool agrees_in_tree(const MapSizes& one) {
  const PaperBands bands;
  return one.tree / one.dense >= bands.octree_low && one.tree / one.dense <= bands.octree_high;
}

std::vector<BarGroup> chart_of(const std::vector<MapSizes>& all) {
  std::vector<BarGroup> groups;
  const auto bar = [](const char* name, double megabytes) {
    return Bar{name, megabytes, formatted("%.1f", megabytes)};
  };
  for (const MapSizes& one : all) {
    BarGroup group{name_of(one),
                   {bar("dense", one.dense / kMegabyte), bar("+ SOR", one.after_sor / kMegabyte),
                    bar("+ SOR + voxel", one.after_voxel / kMegabyte), bar("octree", one.tree / kMegabyte)}};
    if (const PaperSequence* paper = paper_sequence(one.sequence); paper && paper->dense_mb) {
      group.bars.push_back(bar("paper: dense", *paper->dense_mb));
      group.bars.push_back(bar("paper: reduced", *paper->reduced_mb));
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<std::string> missing_from(const std::vector<MapSizes>& all) {
  std::vector<std::string> missing;
  for (const PaperSequence& paper : paper_sequences())
    if (std::none_of(all.begin(), all.end(),
                     [&](const MapSizes& one) { return paper_sequence(one.sequence) == &paper; }))
      missing.push_back(std::string(paper.shown) + " (rgbd_dataset_" + paper.name + ")");
  return missing;
}

Table receipt_table(const std::vector<MapSizes>& base, const std::vector<MapSizes>& bands) {
  Table table{{"sequence", "frames", "voxel.leaf [m]", "octree.resolution_m", "dense [B]", "sor [B]",
               "voxel [B]", "map.ot [B]", "map.bt [B]", "receipts of fuse, sor, voxel, octree"},
              {}};
  std::set<std::string> known;
  for (const auto* some : {&base, &bands})
    for (const MapSizes& one : *some)
      if (known.insert(one.sequence + one.receipts).second)
        table.rows.push_back({{one.sequence},
                              {one.density},
                              {formatted("%g", one.leaf_m), one.leaf_m},
                              {formatted("%g", one.resolution_m), one.resolution_m},
                              shown(one.dense, 0),
                              shown(one.after_sor, 0),
                              shown(one.after_voxel, 0),
                              shown(one.tree, 0),
                              shown(one.tree_binary, 0),
                              {one.receipts}});
  return table;
}

}  // namespace

PaperTables paper_tables(std::span<const RunFacts> base_facts, std::span<const RunFacts> band_facts) {
  const auto base = map_sizes(base_facts), swept = map_sizes(band_facts);
  if (base.empty()) throw std::runtime_error("no instance has results of fuse, sor, voxel and octree");
  std::vector<MapSizes> all = base;
  all.insert(all.end(), swept.begin(), swept.end());
  PaperTables tables;
  tables.sizes = size_table(base);
  tables.sor = sor_table(base);
  const double resolution_m = base.front().resolution_m;
  const std::string density = base.front().density;
  std::vector<MapSizes> by_leaf, by_resolution;
  for (const MapSizes& one : all) {
    if (one.resolution_m == resolution_m) by_leaf.push_back(one);
    if (one.density == density) by_resolution.push_back(one);
  }
  tables.leaf_band = band_table(by_leaf, {{"sequence", "frames fused"},
                                          [](const MapSizes& one) {
                                            return std::vector<std::string>{name_of(one), one.density};
                                          },
                                          [](const MapSizes& one) { return one.leaf_m; },
                                          [](const MapSizes& one) { return one.reduced(); },
                                          agrees_in_size,
                                          "m"});
  tables.tree_band = band_table(
      by_resolution, {{"sequence", "voxel.leaf"},
                      [](const MapSizes& one) {
                        return std::vector<std::string>{name_of(one), formatted("%g m", one.leaf_m)};
                      },
                      [](const MapSizes& one) { return one.resolution_m; },
                      [](const MapSizes& one) { return one.tree / one.dense; },
                      agrees_in_tree,
                      "m"});
  tables.receipts = receipt_table(base, swept);
  tables.chart = chart_of(base);
  tables.missing = missing_from(base);
  tables.settings = base.front().settings +
                    formatted("; voxel.leaf %g m; octree.resolution_m %g", base.front().leaf_m, resolution_m);
  return tables;
}

}  // namespace sediment::tabulate
