#pragma once

#include <string>
#include <vector>

#include "tools/synthesize/random.hpp"
#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

/// Builds a scene piece by piece: names materials, assembles solids.
class Workshop {
 public:
  /// `texel_m` is the finest texel worth having: about a pixel seen from a metre.
  Workshop(std::uint64_t seed, double texel_m) : random(seed), look(mix(seed) % 15), texel_m_(texel_m) {}

  /// A material that repeats every `period_m`.
  int tiled(const Pattern& pattern, double period_m, double coarseness = 1, Rgb tint = {1, 1, 1});
  /// A material that covers a face of this size once.
  int sheet(const Pattern& pattern, double width_m, double height_m, double coarseness = 1);
  /// Another tint of an existing material.
  int tinted(int material, Rgb tint);
  Material& material(int index) { return scene.materials[static_cast<std::size_t>(index)]; }
  /// Plain material with a fine grain.
  int plain(Rgb color);

  /// The scene is done.
  Scene finish() &&;

  /// Adds a body and returns its index.
  int add(std::string name, std::string class_name, bool instance, std::vector<Solid> solids);

  Random random;
  Scene scene;
  std::size_t look;  ///< from the seed: which clothes come first

 private:
  double texel_m_;
  std::vector<Sheet> sheets_;
  int grain_ = -1;
};

/// A pose in the room: position, and turn about the vertical.
Pose placed(Vec3 position, double yaw_rad = 0);

Solid box(Vec3 centre, Vec3 size, int material, double yaw_rad = 0);
/// A box with another material on one face.
Solid box(Vec3 centre, Vec3 size, int material, int face, int face_material, double yaw_rad = 0);
/// An upright cylinder on `foot`.
Solid pillar(Vec3 foot, double radius_m, double height_m, int material);
/// A rod from a to b, its ends round.
Solid limb(Vec3 a, Vec3 b, double radius_a_m, double radius_b_m, int material, double flatten = 1,
           Vec3 side = {1, 0, 0});
/// The solids moved rigidly.
std::vector<Solid> moved(std::vector<Solid> solids, const Pose& pose);

}  // namespace sediment::synthetic
