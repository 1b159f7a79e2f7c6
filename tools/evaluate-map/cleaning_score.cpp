#include "tools/evaluate-map/cleaning_score.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/evaluate-map/surface_score.hpp"
#include "tools/truth/share.hpp"

namespace sediment::tools {
namespace {

std::optional<double> harmonic_mean(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return std::nullopt;
  return *a + *b == 0 ? 0 : 2 * *a * *b / (*a + *b);
}

VoxelSet cells_of(const std::vector<Vec3>& points, double side_m) {
  VoxelSet cells(side_m);
  for (const Vec3& point : points) cells.insert(point);
  return cells;
}

}  // namespace

std::optional<double> CleaningScore::preserved() const {
  return share(still_kept, still);
}

std::optional<double> CleaningScore::rejected() const {
  const auto left = share(dynamic_left, dynamic);
  return left ? std::optional(1 - *left) : std::nullopt;
}

std::optional<double> CleaningScore::f1() const {
  return harmonic_mean(preserved(), rejected());
}

CleaningScore cleaning_score(const std::vector<Vec3>& map, const TrueVoxels& truth) {
  const VoxelSet cells = cells_of(map, truth.still.side_m());
  CleaningScore score;
  score.side_m = truth.still.side_m();
  score.still = truth.still.size();
  score.dynamic = truth.dynamic.size();
  for (const Voxel voxel : truth.still.sorted()) score.still_kept += cells.contains_or_face(voxel) ? 1 : 0;
  for (const Voxel voxel : truth.dynamic.sorted()) score.dynamic_left += cells.contains(voxel) ? 1 : 0;
  return score;
}

std::optional<double> PointScore::associated() const {
  if (!dynamic_accuracy) return std::nullopt;
  return std::sqrt(static_accuracy * *dynamic_accuracy);
}

std::optional<double> PointScore::harmonic() const {
  return harmonic_mean(static_accuracy, dynamic_accuracy);
}

PointScore point_score(const NearestPoint& map, double static_accuracy, const std::vector<Vec3>& dynamic,
                       const TrueVoxels& voxels, double threshold_m) {
  PointScore score;
  score.static_accuracy = static_accuracy;
  std::vector<Vec3> moving;
  for (const Vec3& point : dynamic)
    if (voxels.dynamic.contains(voxels.dynamic.voxel_of(point))) moving.push_back(point);
  if (!moving.empty()) score.dynamic_accuracy = 1 - share_within(moving, map, threshold_m);
  return score;
}

GhostScore ghost_score(const std::vector<Vec3>& map, const VoxelSet& surface,
                       const std::function<bool(Vec3)>& is_free) {
  const VoxelSet cells = cells_of(map, surface.side_m());
  GhostScore score;
  score.cells = cells.size();
  std::vector<Voxel> off;
  for (const Voxel voxel : cells.sorted())
    if (!surface.contains_near(voxel)) off.push_back(voxel);
  score.off_surface = off.size();
  std::vector<char> free(off.size(), 0);
  tbb::parallel_for(std::size_t{0}, off.size(),
                    [&](std::size_t i) { free[i] = is_free(cells.center_of(off[i])); });
  VoxelSet ghosts(surface.side_m());
  for (std::size_t i = 0; i < off.size(); ++i)
    if (free[i] != 0) ghosts.insert(off[i]);
  score.ghosts = ghosts.size();
  const auto clusters = cluster_sizes(ghosts);
  if (!clusters.empty()) score.largest_cluster = clusters.front();
  score.clusters_above_20 = static_cast<std::size_t>(
      std::count_if(clusters.begin(), clusters.end(), [](std::size_t n) { return n > 20; }));
  return score;
}

}  // namespace sediment::tools
