#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

Moment moment_of(const Scene& scene, double time_s) {
  Moment moment;
  int fixed_idx = 0;
  moment.articulated.reserve(scene.bodies.size());  // pointers into it must stay valid
  for (std::size_t body_idx = 0; body_idx < scene.bodies.size(); ++body_idx) {
    const Body& body = scene.bodies[body_idx];
    const std::vector<Solid>* solids = &body.solids;
    if (body.mobility == Mobility::person) {
      moment.articulated.push_back(body.articulated(time_s));
      solids = &moment.articulated.back();
    }
    const Pose world_from_body = body.mobility == Mobility::movable ? body.world_from_body(time_s) : Pose{};
    Vec3 middle;
    for (const Solid& solid : *solids) {
      moment.solids.push_back({&solid, world_from_body * solid.body_from_solid, static_cast<int>(body_idx),
                               body.mobility == Mobility::fixed ? fixed_idx++ : -1});
      middle =
          middle + moment.solids.back().world_from_solid.translation / static_cast<double>(solids->size());
    }
    if (body.mobility != Mobility::fixed) moment.shadows.push_back({middle.x, middle.y, 0.32, middle.z});

    moment.moving.push_back(body.mobility == Mobility::person ||
                            (body.mobility == Mobility::movable && body.moving(time_s)));
  }
  return moment;
}

}  // namespace sediment::synthetic
