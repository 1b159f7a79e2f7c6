#pragma once

#include <opencv2/core.hpp>

#include "pipeline/scene/camera.hpp"
#include "tools/synthesize/scene.hpp"

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

/// Renders with all threads TBB has; the result does not depend on their number.
class Renderer {
 public:
  explicit Renderer(const Camera& camera);
  Rendering render(const Scene& scene, const Moment& moment, const Pose& world_from_camera) const;

 private:
  struct Bounds {
    float x_low, x_high, y_low, y_high;  ///< of rays, normalised image coordinates
  };
  struct View;
  static Bounds bounds_of(const PlacedSolid& placed, const Pose& camera_from_world);
  void find_hits(View& view, int tile_idx) const;
  void paint(View& view, int tile_idx) const;
  void smooth_edges(View& view, int tile_idx, const std::vector<int>& pixels) const;

  Camera camera_;
  std::vector<Ray> rays_;
  int tiles_across_, tiles_down_;
  std::vector<Bounds> tile_bounds_;
};

}  // namespace sediment::synthetic
