#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "pipeline/scene/labelled_point.hpp"
#include "stages/project2d/up_hint.hpp"

namespace octomap {
class ColorOcTree;
}

namespace sediment::project2d {

/// What a grid is made of.
struct MapInput {
  LabelledCloud cloud;  ///< that of the folder; without one the octree's occupied cells
  LabelTable labels;
  std::shared_ptr<octomap::ColorOcTree> tree;  ///< may be missing
};

/// Reads the folders of a cloud, of an octree, or of both; at least one. Throws std::runtime_error that names
/// the file.
MapInput read_map_input(const std::optional<std::filesystem::path>& cloud,
                        const std::optional<std::filesystem::path>& octree);

/// Up from the accelerometer of the sequence, if it has one; else from the cameras' posture.
UpHint read_up(const std::filesystem::path& trajectory, const std::optional<std::filesystem::path>& sequence);

}  // namespace sediment::project2d
