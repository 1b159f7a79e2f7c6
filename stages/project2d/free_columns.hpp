#pragma once

#include <filesystem>

#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/pose.hpp"
#include "stages/project2d/grid_projection.hpp"

namespace octomap {
class ColorOcTree;
}

namespace sediment::project2d {

/// The centres of the smallest cells of the occupied leaves with the labels of their leaves. Throws
/// std::runtime_error that names the folder if there is none.
LabelledCloud occupied_cells(const octomap::ColorOcTree& tree, const std::filesystem::path& folder);

/// What an octree knows of the space above the ground.
class FreeColumns {
 public:
  /// `tree` must live as long as this.
  FreeColumns(const octomap::ColorOcTree& tree, const Pose& map_from_world);

  /// Share of the heights between `low_m` and `high_m` above (x, y) of the map that is known to be free.
  double free_share(double x_m, double y_m, double low_m, double high_m) const;

 private:
  const octomap::ColorOcTree& tree_;
  Pose world_from_map_;
};

/// For project(): whether the tree knows enough of the band to be free, by `min_free_share` or
/// `free_foot_m`. Nothing without a tree, which must live as long as what is returned.
std::function<FreeByRays(const Pose& map_from_world)> free_by_rays(const octomap::ColorOcTree* tree,
                                                                   const GridParameters& parameters);

}  // namespace sediment::project2d
