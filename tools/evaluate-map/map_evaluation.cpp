#include "tools/evaluate-map/map_evaluation.hpp"

#include <octomap/ColorOcTree.h>

#include <cmath>
#include <stdexcept>

#include "pipeline/artifacts/octree.hpp"

namespace sediment::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kRestingCell_m =
    0.01;  ///< objects at rest are seen in every frame: one point a cell is enough

std::vector<Vec3> positions_of(const LabelledCloud& cloud) {
  std::vector<Vec3> positions;
  positions.reserve(cloud.size());
  for (const LabelledPoint& point : cloud) positions.push_back({point.x, point.y, point.z});
  return positions;
}

/// Leaves out what is not finite, and brings the rest into the world of the truth.
LabelledCloud usable(const LabelledCloud& cloud, const Pose& truth_from_map, MapEvaluation& evaluation) {
  LabelledCloud result;
  for (LabelledPoint point : cloud) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
      ++evaluation.not_finite;
      continue;
    }
    const Vec3 at = truth_from_map * Vec3{point.x, point.y, point.z};
    point.x = static_cast<float>(at.x);
    point.y = static_cast<float>(at.y);
    point.z = static_cast<float>(at.z);
    result.push_back(point);
  }
  evaluation.points = result.size();
  if (result.empty()) throw std::runtime_error(evaluation.path + ": holds no finite point");
  return result;
}

void judge_points(const MapTruth& truth, const LabelledCloud& cloud, MapEvaluation& evaluation) {
  const std::vector<Vec3> points = positions_of(cloud);
  const NearestPoint search(points);
  const double threshold_m = truth.rules().threshold_m;
  const auto nearest = truth.surface_search().find_all(points);
  evaluation.surface = surface_score(nearest, search.find_all(truth.still()), threshold_m);
  for (const TrueVoxels& voxels : truth.voxels())
    evaluation.cleaning.push_back(cleaning_score(points, voxels));
  const auto is_free = [&](Vec3 at) { return truth.free_space() && truth.free_space()->contains(at); };
  evaluation.ghosts = ghost_score(points, truth.voxels().front().surface, is_free);
  evaluation.labels = label_score(cloud, nearest, truth.still_cloud(), threshold_m);
  if (truth.sequence())
    evaluation.by_points = point_score(search, evaluation.surface->completion.within, truth.movers().dynamic,
                                       truth.voxels().front(), threshold_m);
}

}  // namespace

MapTruth::MapTruth(TrueSequence sequence, const MapRules& rules)
    : rules_(rules), sequence_(std::move(sequence)) {
  still_cloud_ = sequence_->static_cloud;
  movers_ = mover_points(*sequence_, rules_.max_depth_m, rules_.pixel_step);
  free_space_.emplace(*sequence_, rules_.voxels_m.front());
  prepare();
}

MapTruth::MapTruth(LabelledCloud reference, const MapRules& rules)
    : rules_(rules), still_cloud_(std::move(reference)) {
  prepare();
}

void MapTruth::prepare() {
  still_ = positions_of(still_cloud_);
  surface_ = still_;
  surface_.insert(surface_.end(), movers_.resting.begin(), movers_.resting.end());
  surface_search_ = NearestPoint(surface_);
  for (const double side_m : rules_.voxels_m) voxels_.push_back(true_voxels(still_cloud_, movers_, side_m));
}

MapEvaluation evaluate_map(const MapTruth& truth, const fs::path& map, const Pose& truth_from_map) {
  MapEvaluation evaluation;
  evaluation.path = map.string();
  if (is_cloud(map)) {
    evaluation.kind = "cloud";
    judge_points(truth, usable(read_any_cloud(map), truth_from_map, evaluation), evaluation);
  } else if (fs::exists(map / "map.ot")) {
    evaluation.kind = "octree";
    const auto tree = read_octree(map);
    const LabelledCloud cells = occupied_cells(*tree, map);
    judge_points(truth, usable(cells, truth_from_map, evaluation), evaluation);
    if (truth.sequence())
      evaluation.octree =
          octree_score(*tree, cells, truth_from_map, truth.still(), truth.surface(), *truth.free_space());
  } else if (fs::exists(map / "map.yaml")) {
    evaluation.kind = "grid-map";
    if (!truth.sequence()) throw std::runtime_error(map.string() + ": a grid needs the truth of a sequence");
    evaluation.grid = grid_score(read_grid_map(map), truth_from_map, truth.still(), truth.surface(),
                                 *truth.free_space(), truth.rules().band);
  } else {
    throw std::runtime_error(map.string() +
                             ": no cloud (cloud.pcd, PCD, PLY), octree (map.ot) or grid (map.yaml)");
  }
  return evaluation;
}

}  // namespace sediment::tools
