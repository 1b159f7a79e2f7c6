#include "tools/synthesize/surface_hits.hpp"

#include <cmath>

#include "tools/synthesize/vector_code.hpp"

namespace sediment::synthetic {
namespace {

std::array<float, 3> float3(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// With the ray (x, y, 1).
SEDIMENT_INLINE float along(const std::array<float, 3>& axis, float x, float y) {
  return x * axis[0] + y * axis[1] + axis[2];
}

// With the hit t * ray on the plane n, dt/dx = -t n.x / (n ray).
SEDIMENT_INLINE Footprint reach_on(const FaceView& f, float x, float y, float depth_m, float pixel_angle) {
  // Seen edge-on the footprint has no bound: limited to 20 : 1.
  const float slope = 1 / lesser(along(f.normal, x, y), -0.05f), step = depth_m * pixel_angle;
  const float along_u = slope * along(f.u_axis, x, y), along_v = slope * along(f.v_axis, x, y);
  return {step * (f.u_axis[0] - f.normal[0] * along_u), step * (f.v_axis[0] - f.normal[0] * along_v),
          step * (f.u_axis[1] - f.normal[1] * along_u), step * (f.v_axis[1] - f.normal[1] * along_v)};
}

}  // namespace

FaceView face_view(const Solid& solid, int face, const Pose& camera_from_solid) {
  const Vec3 corner = camera_from_solid * point_on(solid, face, 0, 0);
  const FaceRange range = face_range(solid, face);
  const SurfacePoint middle =
      surface_at(solid, point_on(solid, face, range.u_m / 2, (range.v_low_m + range.v_high_m) / 2));
  FaceView view{float3(camera_from_solid.rotate(middle.normal)),
                float3(camera_from_solid.rotate(middle.u_axis)),
                float3(camera_from_solid.rotate(middle.v_axis)), 0, 0};
  const std::array<float, 3> origin = float3(corner);
  const auto shift = [&](const std::array<float, 3>& axis) {
    return -(origin[0] * axis[0] + origin[1] * axis[1] + origin[2] * axis[2]);
  };
  view.u_shift = shift(view.u_axis), view.v_shift = shift(view.v_axis);
  return view;
}

// The face of the coordinate that is largest on the unit box.
SEDIMENT_CLONES void faces_of(const Target& box, const Hits& hits,
                              std::array<std::int32_t, RayTile::kRays>& faces) {
  for (int i = 0; i < hits.count; ++i) {
    std::int32_t face = 0;
    float largest = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const float* l = box.linear + 3 * axis;
      const float p = box.origin[axis] + hits.depth_m[i] * (l[0] * hits.x[i] + l[1] * hits.y[i] + l[2]);
      face = std::fabs(p) > largest ? 2 * axis + (p > 0) : face;
      largest = greater(std::fabs(p), largest);
    }
    faces[i] = face;
  }
}

SEDIMENT_CLONES void places_of(const FaceView& face, const Hits& hits, float pixel_angle, Places& places) {
  for (int i = 0; i < hits.count; ++i) {
    const float x = hits.x[i], y = hits.y[i], depth_m = hits.depth_m[i];
    const Footprint f = reach_on(face, x, y, depth_m, pixel_angle);
    places.u_m[i] = depth_m * along(face.u_axis, x, y) + face.u_shift;
    places.v_m[i] = depth_m * along(face.v_axis, x, y) + face.v_shift;
    places.du_dx[i] = f.du_dx, places.dv_dx[i] = f.dv_dx, places.du_dy[i] = f.du_dy,
    places.dv_dy[i] = f.dv_dy;
  }
  places.count = hits.count;
}

Footprint footprint_of(const FaceView& tangent, float x, float y, float depth_m, float pixel_angle) {
  return reach_on(tangent, x, y, depth_m, pixel_angle);
}

}  // namespace sediment::synthetic
