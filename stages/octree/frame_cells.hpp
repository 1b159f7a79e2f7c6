#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/pose.hpp"
#include "stages/octree/leaf_points.hpp"

namespace sediment::octree {

struct RayParameters {
  double min_depth_m = 0.4;  ///< nearer depths are not believed
  double max_depth_m = 5.0;  ///< farther pixels clear up to there and fill nothing
  int pixel_step = 1;        ///< every n-th column of every n-th row
};

/// Where a ray ends.
struct RayEnd {
  Keys keys;
  bool fills = true;  ///< false: clears the way and leaves its end alone
};

/// A cube of 8 x 8 x 8 cells. Word z of a mask has bit 8 y + x for the cell (x, y, z) of the cube.
struct Brick {
  std::uint64_t code = 0;  ///< code_of(the keys of its first cell / 8)
  std::array<std::uint64_t, 8> free{}, occupied{};
};

/// What one frame says of the cells, each named once, as OctoMap's discretised insertion counts it
/// (OccupancyOcTreeBase::computeDiscreteUpdate): one ray from the origin to the centre of each cell in which
/// a ray ends; the cells on the way are free; cells in which a ray ends that fills are occupied, and not
/// free. The cells are those of OctoMap's computeRayKeys, rounding included. Bricks are in the order of their
/// codes. Throws std::runtime_error if the frame spans more than 2^33 cells.
std::vector<Brick> cells_of_rays(Vec3 origin, std::span<const RayEnd> ends, double resolution_m);

/// A depth image and where it was taken.
struct DepthView {
  Pose world_from_camera;
  cv::Mat depth;    ///< CV_16UC1, 0 = no value
  cv::Mat dynamic;  ///< CV_8UC1 of DynamicValue; may be empty: everything is static
};

/// The ends of a frame's rays: pixels with depth. What is dynamic or too far does not fill.
std::vector<RayEnd> ray_ends(const DepthView& view, const Camera& camera, std::span<const Ray> rays,
                             const RayParameters& parameters, double resolution_m);

}  // namespace sediment::octree
