#pragma once

#include <vector>

#include "pipeline/scene/labelled_point.hpp"
#include "tools/synthesize/renderer.hpp"

namespace sediment::synthetic {

/// Distance of points of the static cloud, metres.
inline constexpr double kCloudSpacing = 0.01;

/// Remembers which parts of all that never moves were seen, in cells of the surfaces. What was seen does not
/// depend on the order of the frames.
class SeenSurface {
 public:
  SeenSurface(const Scene& scene, double cell_m);

  /// Adds what `rendering` shows where the sensor gave depth (`depth` not 0). Not safe to call from several
  /// threads at once.
  void add(const Rendering& rendering, const Moment& moment, const cv::Mat& depth);

  /// The middle of every cell seen, in the order of solids and cells, with colour, label and body as
  /// instance.
  LabelledCloud cloud(const Lighting& lighting, const LabelTable& labels) const;

 private:
  struct Grid {
    int body_idx, solid_idx, face, fixed_idx;
    int columns, rows;
    double cell_u_m, cell_v_m, v_low_m;
    std::vector<std::uint8_t> seen;
  };
  LabelledPoint point_of(const Grid& grid, int column, int row, const Lighting& lighting) const;

  const Scene& scene_;
  std::vector<Grid> grids_;
  std::vector<int> first_grid_;  ///< by PlacedSolid::fixed_idx
};

}  // namespace sediment::synthetic
