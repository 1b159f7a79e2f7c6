#pragma once

#include <functional>
#include <optional>

#include "tools/evaluate-map/true_surfaces.hpp"

namespace sediment::tools {

/// ERASOR's figures by cells: what is kept of what never moves, what is removed of what moves.
struct CleaningScore {
  double side_m = 0.05;
  std::size_t still = 0, still_kept = 0;      ///< kept: the map has a point in the cell or a face neighbour
  std::size_t dynamic = 0, dynamic_left = 0;  ///< left: the map has a point in the cell
  std::optional<double> preserved() const;    ///< PR; none if there is nothing to preserve
  std::optional<double> rejected() const;     ///< RR; none if nothing moves
  std::optional<double> f1() const;
};
CleaningScore cleaning_score(const std::vector<Vec3>& map, const TrueVoxels& truth);

/// DynamicMap_Benchmark's figures by points: a true point is in the map if that has a point within the
/// threshold.
struct PointScore {
  double static_accuracy = 0;                ///< SA: static points kept
  std::optional<double> dynamic_accuracy;    ///< DA: dynamic points removed; none if nothing moves
  std::optional<double> associated() const;  ///< AA = sqrt(SA * DA)
  std::optional<double> harmonic() const;    ///< HA = 2 SA DA / (SA + DA)
};
/// `static_accuracy` is the completeness of the surfaces. Of the dynamic points those in the cells of
/// `voxels.dynamic` count.
PointScore point_score(const NearestPoint& map, double static_accuracy, const std::vector<Vec3>& dynamic,
                       const TrueVoxels& voxels, double threshold_m);

/// Cells of the map where no true surface is.
struct GhostScore {
  std::size_t cells = 0;        ///< of the map
  std::size_t off_surface = 0;  ///< of those, without a true surface within one cell (of 26)
  std::size_t ghosts = 0;       ///< of those, in space that was seen to be free
  std::size_t largest_cluster = 0, clusters_above_20 = 0;  ///< of ghosts that touch
};
GhostScore ghost_score(const std::vector<Vec3>& map, const VoxelSet& surface,
                       const std::function<bool(Vec3)>& is_free);

}  // namespace sediment::tools
