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

/// Share of the heights from `low_m` to `high_m` that the tree knows to be free, for project(). Nothing
/// without a tree, which must live as long as what is returned.
std::function<FreeShare(const Pose& map_from_world)> free_shares(const octomap::ColorOcTree* tree,
                                                                 double low_m, double high_m);

}  // namespace sediment::project2d
