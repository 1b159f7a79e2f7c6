#include "tools/synthesize/workshop.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synthesize/patterns.hpp"

namespace sediment::synthetic {

int Workshop::tiled(const Pattern& pattern, double period_m, double coarseness, Rgb tint) {
  sheets_.push_back({pattern, period_m, period_m, texel_m_ * coarseness, true});
  scene.materials.push_back({static_cast<int>(sheets_.size()) - 1, tint});
  return static_cast<int>(scene.materials.size()) - 1;
}

int Workshop::sheet(const Pattern& pattern, double width_m, double height_m, double coarseness) {
  sheets_.push_back({pattern, width_m, height_m, texel_m_ * coarseness, false});
  scene.materials.push_back({static_cast<int>(sheets_.size()) - 1});
  return static_cast<int>(scene.materials.size()) - 1;
}

Scene Workshop::finish() && {
  for (Sheet& sheet : sheets_) scene.textures.emplace_back(std::move(sheet));
  return std::move(scene);
}

int Workshop::tinted(int original, Rgb tint) {
  Material copy = material(original);
  copy.tint = tint;
  scene.materials.push_back(copy);
  return static_cast<int>(scene.materials.size()) - 1;
}

int Workshop::plain(Rgb color) {
  if (grain_ < 0) grain_ = tiled(grain(random.next(), 0.06), 0.8);
  return tinted(grain_, color);
}

int Workshop::add(std::string name, std::string class_name, bool instance, std::vector<Solid> solids) {
  scene.bodies.push_back(
      {std::move(name), std::move(class_name), Mobility::fixed, instance, std::move(solids), {}, {}, {}});
  return static_cast<int>(scene.bodies.size()) - 1;
}

Pose placed(Vec3 position, double yaw_rad) {
  Pose pose = rotation_from({0, 0, yaw_rad});
  pose.translation = position;
  return pose;
}

Solid box(Vec3 centre, Vec3 size, int material, double yaw_rad) {
  Solid solid;
  solid.size = 0.5 * size;
  solid.body_from_solid = placed(centre, yaw_rad);
  solid.materials.fill(material);
  return solid;
}

Solid box(Vec3 centre, Vec3 size, int material, int face, int face_material, double yaw_rad) {
  Solid solid = box(centre, size, material, yaw_rad);
  solid.materials[static_cast<std::size_t>(face)] = face_material;
  return solid;
}

Solid pillar(Vec3 foot, double radius_m, double height_m, int material) {
  Solid solid;
  solid.shape = Shape::cylinder;
  solid.size = {radius_m, radius_m, height_m};
  solid.body_from_solid = placed(foot);
  solid.materials.fill(material);
  return solid;
}

Solid limb(Vec3 a, Vec3 b, double radius_a_m, double radius_b_m, int material, double flatten, Vec3 side) {
  Solid solid;
  solid.shape = Shape::capsule;
  // The hull of two balls needs an axis, and a ball must not lie inside the other.
  const double least = std::max(1e-3, 1.05 * std::abs(radius_a_m - radius_b_m));
  const double length = std::max(norm(b - a), least);
  const Vec3 z = norm(b - a) > 1e-6 ? normalized(b - a) : Vec3{0, 0, 1};
  const Vec3 y = normalized(cross(z, std::abs(dot(z, side)) > 0.99 ? Vec3{0, 1, 0.2} : side)),
             x = cross(y, z);
  solid.size = {radius_a_m, radius_b_m, length};
  solid.flatten = flatten;
  solid.body_from_solid.rotation = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  solid.body_from_solid.translation = a;
  solid.materials.fill(material);
  return solid;
}

std::vector<Solid> moved(std::vector<Solid> solids, const Pose& pose) {
  for (Solid& solid : solids) solid.body_from_solid = pose * solid.body_from_solid;
  return solids;
}

}  // namespace sediment::synthetic
