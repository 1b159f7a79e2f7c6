#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sediment {

/// Label of a point that belongs to no class of the table.
inline constexpr std::uint32_t kUnlabelled = 255;

/// One semantic class.
struct Label {
  std::uint32_t id = kUnlabelled;     ///< COCO index 0 .. 79 for COCO's classes, 100 and up for others
  std::string name;                   ///< as segmentation networks write it
  std::array<std::uint8_t, 3> rgb{};  ///< colour in clouds, octrees and overlays
  bool prior_dynamic = false;         ///< moves by itself: people and animals (paper, table 1)
};

/// The classes known to a pipeline, found by name or by id.
class LabelTable {
 public:
  LabelTable() = default;
  /// Throws std::invalid_argument if a name or an id occurs twice.
  explicit LabelTable(std::vector<Label> labels);

  /// Ordered by id.
  const std::vector<Label>& labels() const { return labels_; }
  /// nullptr if there is none.
  const Label* find(std::string_view name) const;
  const Label* find(std::uint32_t id) const;

 private:
  std::vector<Label> labels_;
};

}  // namespace sediment
