#pragma once

#include <opencv2/core.hpp>

#include "pipeline/scene/camera.hpp"
#include "tools/synthesize/lighting.hpp"
#include "tools/synthesize/ray_tile.hpp"

namespace sediment::synthetic {

/// A picture of the scene at one time. Everything but the colour comes from the ray through the pixel centre:
/// exact, with hard edges.
struct Rendering {
  cv::Mat color;    ///< CV_8UC3 BGR; edges of things are averaged over the pixel
  cv::Mat depth_m;  ///< CV_32FC1, along the optical axis; 0 = the ray hits nothing
  cv::Mat solid;    ///< CV_32SC1, index into Moment::solids, -1 = none
  cv::Mat face;     ///< CV_8UC1, face of that solid
  cv::Mat place;    ///< CV_32FC2, u and v on that face, metres
};

/// Casts a ray through every pixel, tile by tile: solids are sorted into the tiles they may touch, the rays
/// of a tile are cast together. Uses all threads TBB has; the result does not depend on their number.
class Renderer {
 public:
  explicit Renderer(const Camera& camera);
  Rendering render(const Scene& scene, const Lighting& lighting, const Moment& moment,
                   const Pose& world_from_camera) const;

 private:
  struct Work;
  void paint(Work& work, int tile_idx) const;
  std::vector<int> edge_pixels(const Work& work, int tile_idx) const;
  void smooth_edges(Work& work, int tile_idx) const;
  cv::Rect area_of(int tile_idx) const;

  Camera camera_;
  std::vector<Ray> rays_;
  int tiles_across_, tiles_down_;
  std::vector<RayBounds> tile_bounds_;
};

}  // namespace sediment::synthetic
