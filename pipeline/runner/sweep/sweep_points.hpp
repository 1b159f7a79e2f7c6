#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/runner/sweep/sweep_file.hpp"

namespace sediment::runner {

/// One instance of a sweep.
struct SweepPoint {
  std::string name;  ///< "walking/voxel.leaf_size=0.02,sor.neighbors=30": its folder below --out
  std::vector<std::pair<std::string, std::string>> values;  ///< name on an axis, value as shown in tables
  std::vector<Setting> sources, parameters;
};

/// All combinations of the axes, the last axis fastest. Names are unique.
std::vector<SweepPoint> points_of(const SweepFile& sweep);

/// sweep.json in the folder of the results: the points, for tables that are made later.
void write_points(const std::vector<SweepPoint>& points, const std::filesystem::path& out);

/// Reads sweep.json; a folder without one is the result of one run: one point without values.
std::vector<SweepPoint> read_points(const std::filesystem::path& out);

}  // namespace sediment::runner
