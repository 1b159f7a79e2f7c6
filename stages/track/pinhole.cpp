#include "stages/track/pinhole.hpp"

#include <algorithm>

namespace sediment::track {

Pinhole pinhole_of(const Camera& camera, const Parameters& parameters) {
  Pinhole pinhole{camera.fx, camera.fy, camera.cx, camera.cy};
  pinhole.pixel_sigma_px = parameters.pixel_noise_px;
  pinhole.depth_sigma = parameters.depth_noise;
  pinhole.right = camera.width;
  pinhole.bottom = camera.height;
  if (!camera.has_distortion()) return pinhole;
  // Barrel distortion is largest in the corners, cushion in the middle of the sides: the widest of eight.
  for (const double u : {0.0, 0.5 * camera.width, 1.0 * camera.width})
    for (const double v : {0.0, 0.5 * camera.height, 1.0 * camera.height}) {
      const Pixel ray = camera.undistort({u, v});
      pinhole.left = std::min(pinhole.left, camera.fx * ray.u + camera.cx);
      pinhole.right = std::max(pinhole.right, camera.fx * ray.u + camera.cx);
      pinhole.top = std::min(pinhole.top, camera.fy * ray.v + camera.cy);
      pinhole.bottom = std::max(pinhole.bottom, camera.fy * ray.v + camera.cy);
    }
  return pinhole;
}

}  // namespace sediment::track
