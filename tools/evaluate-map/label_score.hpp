#pragma once

#include <map>
#include <optional>

#include "pipeline/scene/labelled_point.hpp"
#include "tools/evaluate-map/nearest_point.hpp"

namespace sediment::tools {

/// Points of the map by their own label and that of the nearest true point.
struct LabelPixels {
  std::size_t both = 0, only_map = 0, only_truth = 0;
  double iou() const { return static_cast<double>(both) / static_cast<double>(both + only_map + only_truth); }
};

struct LabelScore {
  std::map<std::uint32_t, LabelPixels> classes;  ///< those asked for, that truly occur
  std::optional<double> mean_iou() const;        ///< none if no class is asked for
};

/// Compares the labels of the points of the map whose nearest true point (`nearest`, an index into `truth` or
/// beyond it where that is no point of `truth`) is within the threshold. Asked for are the classes of COCO,
/// and all others only if the map has points of any such class (networks do not know walls). A class counts
/// if at least `least_points` points of the map lie on it. No class is asked for if the map has no label at
/// all.
LabelScore label_score(const LabelledCloud& map, const std::vector<NearestPoint::Found>& nearest,
                       const LabelledCloud& truth, double threshold_m, std::size_t least_points = 50);

}  // namespace sediment::tools
