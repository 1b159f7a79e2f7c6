#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

Moment moment_of(const Scene& scene, double time_s) {
  Moment moment;
  moment.articulated.reserve(scene.bodies.size());  // pointers into it must stay valid
  for (std::size_t body_idx = 0; body_idx < scene.bodies.size(); ++body_idx) {
    const Body& body = scene.bodies[body_idx];
    const std::vector<Solid>* solids = &body.solids;
    if (body.mobility == Mobility::person) {
      moment.articulated.push_back(body.articulated(time_s));
      solids = &moment.articulated.back();
    }
    const Pose world_from_body = body.mobility == Mobility::movable ? body.world_from_body(time_s) : Pose{};
    for (const Solid& solid : *solids)
      moment.solids.push_back({&solid, world_from_body * solid.body_from_solid, static_cast<int>(body_idx)});
    moment.moving.push_back(body.mobility == Mobility::person ||
                            (body.mobility == Mobility::movable && body.moving(time_s)));
  }
  return moment;
}

}  // namespace sediment::synthetic
