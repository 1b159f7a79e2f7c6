#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/synthesize/solid.hpp"
#include "tools/synthesize/texture.hpp"

namespace sediment::synthetic {

/// What a face is made of.
struct Material {
  int texture = 0;       ///< index into Scene::textures
  Rgb tint{1, 1, 1};     ///< multiplied with the texture
  float depth_loss = 0;  ///< share of the depth pixels that get no value: dark or shiny surfaces
  float glow = 0;        ///< light of its own, 1 = shown as painted whatever the lighting (screens, lamps)
};

enum class Mobility { fixed, movable, person };

/// A thing in the room: one instance of the truth masks if networks know its class.
struct Body {
  std::string name;        ///< "pushed chair"
  std::string class_name;  ///< of the label table: "chair", "wall", ...
  Mobility mobility = Mobility::fixed;
  bool instance = false;                               ///< a segmentation network would find it
  std::vector<Solid> solids;                           ///< at rest; of a person at any time, for their number
  std::function<Pose(double time_s)> world_from_body;  ///< of movable bodies
  std::function<bool(double time_s)> moving;           ///< of movable bodies: is it moved right now
  std::function<std::vector<Solid>(double time_s)> articulated;  ///< of persons: solids in the world frame
};

/// A panel that shines downward.
struct Lamp {
  Vec3 position;
  double width_m, depth_m;
  Rgb power;
};

/// All that is in the room. The id of a body is its index + 1.
struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Lamp> lamps;
  Rgb thrown_back;           ///< strength of the light that walls, floor and ceiling throw back
  Vec3 room_low, room_high;  ///< inner corners of the room, metres
};

/// A solid where it is at one time.
struct PlacedSolid {
  const Solid* solid;
  Pose world_from_solid;
  int body_idx;
  int fixed_idx;  ///< among all solids that never move, -1 = may move
};

/// The soft shadow that a moving thing leaves on what is below it.
struct SoftShadow {
  double x, y, radius_m, top_m;
};

/// All solids at one time.
struct Moment {
  std::vector<PlacedSolid> solids;  ///< in the order of the bodies
  std::vector<bool> moving;         ///< by body: a person, or an object moved at this time
  std::vector<SoftShadow> shadows;
  std::vector<std::vector<Solid>> articulated;  ///< owns the solids of persons
};
Moment moment_of(const Scene& scene, double time_s);

}  // namespace sediment::synthetic
