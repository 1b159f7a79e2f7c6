#include "stages/track/bundle_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stages/track/normal_equations.hpp"

namespace sediment::track {
namespace {

// Levenberg and Marquardt with the trust region of Ceres, which is Madsen, Nielsen and Tingleff's.
double descend(NormalEquations& equations, BundleState& state, const AdjustmentRule& rule) {
  double cost = equations.cost(state), radius = 1e4, shrink = 2;
  if (!std::isfinite(cost)) throw std::runtime_error("bundle adjustment starts with a point behind a camera");
  bool moved = true;
  for (int i = 0; i < rule.max_iterations && radius > 1e-12; ++i) {
    if (moved) equations.linearise(state);
    moved = false;
    if (equations.solve(1 / radius)) {
      BundleState next = equations.moved(state);
      const double next_cost = equations.cost(next), gain = cost - next_cost;
      const double quality = gain / equations.promised_gain();
      if (gain > 0 && quality > 1e-3) {
        state = std::move(next);
        moved = true;
        const bool small = gain < rule.least_gain * cost;
        cost = next_cost;
        radius = std::min(1e16, radius / std::max(1.0 / 3, 1 - std::pow(2 * quality - 1, 3)));
        shrink = 2;
        if (small) break;
        continue;
      }
      if (std::abs(gain) < rule.least_gain * cost) break;
    }
    radius /= shrink;
    shrink *= 2;
  }
  return cost;
}

}  // namespace

double adjust(Bundle& bundle, const Pinhole& pinhole, const AdjustmentRule& rule) {
  BundleState state;
  for (const Bundle::Camera& camera : bundle.cameras) state.cameras.push_back(camera.camera_from_world);
  state.points = bundle.points;
  NormalEquations equations(bundle, pinhole, rule);
  const double cost = descend(equations, state, rule);
  // Many products of rotations leave the group by rounding.
  for (std::size_t i = 0; i < state.cameras.size(); ++i)
    if (!bundle.cameras[i].fixed)
      bundle.cameras[i].camera_from_world =
          pose_from(quaternion_of(state.cameras[i]), state.cameras[i].translation);
  bundle.points = std::move(state.points);
  bundle.timing.readout_s += state.timing[0];
  bundle.timing.depth_lag_s += state.timing[1];
  return cost;
}

double chi_square(const Bundle& bundle, const Bundle::Observation& observation, const Pinhole& pinhole) {
  const Vec3 p =
      bundle.cameras[observation.camera_idx].camera_from_world * bundle.points[observation.point_idx];
  if (p.z < kProjectable_m) return 1e9;
  return squared(residual_of(observation.measurement, pinhole, p));
}

}  // namespace sediment::track
