#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "pipeline/scene/labels.hpp"

namespace octomap {
class ColorOcTree;
}

namespace sediment {

/// A label that a leaf might have instead.
struct OtherLabel {
  std::uint32_t label = kUnlabelled;
  float confidence = 0;

  friend bool operator==(const OtherLabel&, const OtherLabel&) = default;
};

/// Label of one occupied leaf at the finest level of the tree (leaves pruned to a coarser level are listed
/// once).
struct LeafLabel {
  std::uint16_t key[3] = {0, 0, 0};  ///< OctoMap key of the leaf at its depth
  std::uint8_t depth = 16;
  std::uint32_t label = kUnlabelled;
  float confidence = 1;                ///< 0 .. 1
  std::array<OtherLabel, 2> others{};  ///< the next best; confidence 0: there is none
};

/// Writes the `octree` artifact: map.ot (ColorOcTree), map.bt (occupancy only), leaf_labels.csv
/// (key_x,key_y,key_z,depth,label and what follows), labels.csv (id,name,r,g,b). Throws std::runtime_error
/// that names the file.
void write_octree(const std::filesystem::path& folder, octomap::ColorOcTree& tree,
                  const std::vector<LeafLabel>& leaf_labels, const LabelTable& labels);

/// Reads map.ot of a folder. Throws std::runtime_error that names the file: missing, truncated, another tree
/// class.
std::unique_ptr<octomap::ColorOcTree> read_octree(const std::filesystem::path& folder);
std::vector<LeafLabel> read_leaf_labels(const std::filesystem::path& folder);

}  // namespace sediment
