#include "tools/synthesize/ray_tile.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tools/synthesize/random.hpp"
#include "tools/synthesize/workshop.hpp"

using namespace sediment;
using namespace sediment::synthetic;

namespace {

RayTile tile_towards(float x_from, float x_to) {
  RayTile tile;
  for (int i = 0; i < RayTile::kRays; ++i) {
    tile.x[i] = x_from + (x_to - x_from) * static_cast<float>(i % 16) / 15;
    tile.y[i] = x_from + (x_to - x_from) * static_cast<float>(i / 16) / 15;
  }
  tile.start();
  return tile;
}

/// Distance of a point to a solid's surface, by its definition (negative inside).
double distance_to(const Solid& s, Vec3 p) {
  p.y /= s.flatten;
  if (s.shape == Shape::box)
    return std::max({std::abs(p.x) - s.size.x, std::abs(p.y) - s.size.y, std::abs(p.z) - s.size.z});
  const double radial = std::hypot(p.x, p.y);
  if (s.shape == Shape::cylinder) return std::max({radial - s.size.x, -p.z, p.z - s.size.z});
  double least = 1e9;  // hull of two balls: union of balls whose centres and radii run from one to the other
  for (int i = 0; i <= 4000; ++i) {
    const double t = i / 4000.0;
    least = std::min(least, std::hypot(radial, p.z - t * s.size.z) - std::lerp(s.size.x, s.size.y, t));
  }
  return least;
}

Solid some_solid(Random& random, Shape shape) {
  Solid s;
  s.shape = shape;
  s.size = {random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.3, 0.8)};
  // Neither ball of a capsule lies inside the other.
  if (shape == Shape::capsule) s.size.z += std::abs(s.size.x - s.size.y);
  if (shape != Shape::box) s.flatten = random.uniform(0.6, 1.2);
  s.body_from_solid = rotation_from({random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)});
  s.body_from_solid.translation = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                   random.uniform(2, 3)};
  return s;
}

}  // namespace

TEST_CASE("a ray meets a box that faces the camera at its distance") {
  RayTile tile = tile_towards(-0.05f, 0.05f);
  const Solid solid = box({0, 0, 3}, {1, 1, 2}, 0);
  cast(target_of(solid, solid.body_from_solid), reach_of(solid, solid.body_from_solid), 4, tile);
  for (int i = 0; i < RayTile::kRays; ++i) {
    CHECK(tile.depth_m[i] == Approx(2).epsilon(1e-6));
    CHECK(tile.solid[i] == 4);
  }
}

TEST_CASE("hits lie on the surface and nothing of the solid is before them") {
  Random random(5);
  for (const Shape shape : {Shape::box, Shape::capsule, Shape::cylinder})
    for (int round = 0; round < 12; ++round) {
      const Solid solid = some_solid(random, shape);
      RayTile tile = tile_towards(-0.4f, 0.4f);
      cast(target_of(solid, solid.body_from_solid), reach_of(solid, solid.body_from_solid), 0, tile);
      const Pose solid_from_camera = solid.body_from_solid.inverse();
      CHECK(std::count(tile.solid.begin(), tile.solid.end(), 0) > 0);
      for (int i = 0; i < RayTile::kRays; i += 5) {
        const auto at = [&](double depth) {
          return distance_to(solid, solid_from_camera * (depth * Vec3{tile.x[i], tile.y[i], 1}));
        };
        const bool hit = tile.solid[i] == 0;
        if (hit) CHECK(std::abs(at(tile.depth_m[i])) < 2e-4);
        double least = 1e9;
        for (double depth = 0.5; depth < (hit ? tile.depth_m[i] - 0.002 : 5.0); depth += 0.02)
          least = std::min(least, at(depth));
        CHECK(least > -2e-4);
      }
    }
}

TEST_CASE("the place on a surface and its point are each other's inverse, with the normal outward") {
  Random random(6);
  for (const Shape shape : {Shape::box, Shape::capsule, Shape::cylinder})
    for (int round = 0; round < 200; ++round) {
      Solid solid = some_solid(random, shape);

      const int face = random.integer(0, face_count(shape) - 1);
      const FaceRange range = face_range(solid, face);
      const double u = random.uniform(0.05, 0.95) * range.u_m,
                   v = std::lerp(range.v_low_m, range.v_high_m, random.uniform(0.05, 0.95));
      const Vec3 point = point_on(solid, face, u, v);
      const bool rim =
          shape == Shape::cylinder && face > 0 && std::hypot(point.x, point.y / solid.flatten) > solid.size.x;
      if (rim) continue;  // corners of a cap's square are not on the cap
      CHECK(std::abs(distance_to(solid, point)) < 1e-3);
      const SurfacePoint at = surface_at(solid, point);
      CHECK(at.face == face);
      CHECK(at.u_m == Approx(u).margin(1e-4));
      CHECK(at.v_m == Approx(v).margin(1e-4));
      CHECK(norm(at.normal) == Approx(1));
      CHECK(distance_to(solid, point + 0.02 * at.normal) > distance_to(solid, point) + 0.005);
    }
}

TEST_CASE("no ray outside a solid's reach meets it") {
  const Reach everywhere{{-kFar, kFar, -kFar, kFar}, 0};
  Random random(8);
  for (const Shape shape : {Shape::box, Shape::capsule, Shape::cylinder})
    for (int round = 0; round < 100; ++round) {
      Solid solid = some_solid(random, shape);
      solid.body_from_solid.translation.z = random.uniform(0.2, 2);  // some reach behind the camera
      const Reach reach = reach_of(solid, solid.body_from_solid);
      RayTile tile = tile_towards(-1.5f, 1.5f);
      cast(target_of(solid, solid.body_from_solid), everywhere, 0, tile);
      for (int i = 0; i < RayTile::kRays; ++i) {
        if (tile.solid[i] < 0) continue;
        RayBounds ray;
        ray.include(tile.x[i], tile.y[i]);
        CHECK(ray.meets(reach.rays));
        CHECK(tile.depth_m[i] >= reach.nearest_m - 1e-5f);
      }
    }
}
