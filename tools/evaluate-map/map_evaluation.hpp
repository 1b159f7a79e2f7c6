#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate-map/cleaning_score.hpp"
#include "tools/evaluate-map/grid_score.hpp"
#include "tools/evaluate-map/label_score.hpp"
#include "tools/evaluate-map/octree_score.hpp"
#include "tools/evaluate-map/surface_score.hpp"

namespace sediment::tools {

struct MapRules {
  double threshold_m = 0.05;  ///< a point agrees with another one at most as far away
  double max_depth_m = 5;     ///< of dynamic pixels
  int pixel_step = 2;         ///< every how many-th pixel of a row and of a column is back-projected
  std::vector<double> voxels_m{0.05, 0.2};
  HeightBand band;
};

/// The truth prepared once for many maps: a sequence with its truth, or only a reference cloud.
class MapTruth {
 public:
  MapTruth(TrueSequence sequence, const MapRules& rules);
  MapTruth(LabelledCloud reference, const MapRules& rules);

  const MapRules& rules() const { return rules_; }
  const std::optional<TrueSequence>& sequence() const { return sequence_; }
  const LabelledCloud& still_cloud() const { return still_cloud_; }
  const std::vector<Vec3>& still() const { return still_; }
  /// The points of `still`, then those of objects at rest.
  const std::vector<Vec3>& surface() const { return surface_; }
  const MoverPoints& movers() const { return movers_; }
  const NearestPoint& surface_search() const { return surface_search_; }
  const std::vector<TrueVoxels>& voxels() const { return voxels_; }  ///< by rules().voxels_m
  const std::optional<FreeSpace>& free_space() const { return free_space_; }

 private:
  void prepare();

  MapRules rules_;
  std::optional<TrueSequence> sequence_;
  LabelledCloud still_cloud_;
  std::vector<Vec3> still_, surface_;
  MoverPoints movers_;
  NearestPoint surface_search_{{}};
  std::vector<TrueVoxels> voxels_;
  std::optional<FreeSpace> free_space_;
};

/// Everything measured of one map. What a kind of map or of truth does not allow is left out.
struct MapEvaluation {
  std::string path, kind;  ///< cloud, octree or grid-map
  std::string alignment;   ///< how the map came into the world of the truth, for people
  std::size_t points = 0, not_finite = 0;
  std::optional<SurfaceScore> surface;
  std::vector<CleaningScore> cleaning;  ///< by voxel size
  std::optional<PointScore> by_points;
  std::optional<GhostScore> ghosts;
  std::optional<LabelScore> labels;
  std::optional<OctreeScore> octree;
  std::optional<GridScore> grid;
};

/// A map is a cloud (folder, PCD or PLY file), an octree folder or a grid folder. Throws std::runtime_error
/// that names it if it is none of these or empty, or if the truth is only a reference cloud and the map a
/// grid.
MapEvaluation evaluate_map(const MapTruth& truth, const std::filesystem::path& map,
                           const Pose& truth_from_map);

std::string to_text(const MapEvaluation& evaluation);
nlohmann::ordered_json to_json(const MapEvaluation& evaluation);

}  // namespace sediment::tools
