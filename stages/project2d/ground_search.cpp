#include "stages/project2d/ground_search.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "pipeline/contract/errors.hpp"
#include "stages/project2d/plane_search.hpp"

namespace sediment::project2d {
namespace {

/// A world frame whose z = 0 is (nearly) the floor is a map frame, not that of a first camera.
constexpr double kOriginOnFloor_m = 0.3;

/// A floor is at least this large a share of the largest horizontal plane.
constexpr double kFloorShare = 0.2;
/// Planes this far from the levelled axis are horizontal.
constexpr double kHorizontal_deg = 5;

const UpHint kMapFrame{{0, 0, 1}, 5, "z of the world is up"};
const UpHint kCameraFrame{kUpwardOfCamera, 45, "the first camera was held upright"};

/// A floor smaller than this share of it takes its direction from that plane: the other one is longer and
/// both are level.
constexpr double kOwnDirectionShare = 0.5;

struct Candidate {
  Layer layer;
  double below;  ///< share of the surface that lies below it
};

/// Planes across the upward direction, largest first, without ceilings.
std::vector<Candidate> candidates_of(std::span<const Vec3> points, const UpHint& hint,
                                     const GroundParameters& parameters) {
  const Surface surface = sample_surface(points, parameters.tolerance_m);
  std::vector<Candidate> candidates;
  for (const SurfacePlane& found :
       find_planes(surface, hint.up, hint.within_deg, parameters.tolerance_m, parameters.min_area_m2)) {
    const Layer layer =
        fit_layer(points, dot(found.plane.normal, hint.up) < 0 ? found.plane.flipped() : found.plane,
                  parameters.tolerance_m);
    const auto below = std::count_if(surface.samples.begin(), surface.samples.end(), [&](Vec3 p) {
      return layer.plane.height_m(p) < -3 * parameters.tolerance_m;
    });
    const double share = static_cast<double>(below) / static_cast<double>(surface.samples.size());
    if (share < 0.5) candidates.push_back({layer, share});
  }
  return candidates;
}

/// The world turned so that the plane is z = 0.
std::vector<Vec3> levelled(std::span<const Vec3> points, const Pose& map_from_world) {
  std::vector<Vec3> turned(points.size());
  std::transform(points.begin(), points.end(), turned.begin(), [&](Vec3 p) { return map_from_world * p; });
  return turned;
}

/// The largest, by area times `weight`, of the candidates that `weight` does not rule out with 0.
template <class Weight>
const Candidate* largest(const std::vector<Candidate>& candidates, Weight weight) {
  const Candidate* best = nullptr;
  double most = 0;
  for (const Candidate& c : candidates)
    if (const double area = c.layer.area_m2 * weight(c); area > most) most = area, best = &c;
  return best;
}

/// The ground in a world that is level already: the largest plane that (nearly) nothing lies below, if it is
/// not small beside the largest of all; else the latter.
std::optional<Ground> choose(const std::vector<Candidate>& candidates, const GroundParameters& parameters) {
  const Candidate* support = largest(candidates, [](const Candidate&) { return 1.0; });
  if (support == nullptr) return std::nullopt;
  const Candidate* floor =
      largest(candidates, [&](const Candidate& c) { return c.below <= parameters.max_below ? 1.0 : 0.0; });
  const bool is_floor = floor != nullptr && floor->layer.area_m2 >= kFloorShare * support->layer.area_m2;
  const Candidate& chosen = is_floor ? *floor : *support;
  Plane plane = chosen.layer.plane;
  if (chosen.layer.area_m2 < kOwnDirectionShare * support->layer.area_m2) {
    plane.normal = support->layer.plane.normal;
    plane.offset_m = -dot(plane.normal, chosen.layer.center);
  }
  return Ground{plane,        is_floor ? "floor: " : "largest support, no floor is seen: ",
                is_floor,     chosen.layer.area_m2,
                chosen.below, chosen.layer.rms_m};
}

/// Two rounds. The plane that best fits the hint, floor or desk, levels the world; there, horizontal planes
/// are told apart sharply, and one of them is the ground.
std::optional<Ground> search(std::span<const Vec3> points, const UpHint& hint,
                             const GroundParameters& parameters) {
  const auto rough = candidates_of(points, hint, parameters);
  const Candidate* level =
      largest(rough, [&](const Candidate& c) { return std::pow(dot(c.layer.plane.normal, hint.up), 2); });
  if (level == nullptr) return std::nullopt;
  const Pose level_from_world = map_from_world(level->layer.plane);
  const UpHint upward{{0, 0, 1}, kHorizontal_deg, ""};
  auto ground = choose(candidates_of(levelled(points, level_from_world), upward, parameters), parameters);
  if (!ground) return std::nullopt;
  ground->plane.offset_m += dot(ground->plane.normal, level_from_world.translation);
  ground->plane.normal = level_from_world.inverse().rotate(ground->plane.normal);
  ground->source += hint.source;
  return ground;
}

/// Nobody says where up is. The world is a map frame if its z = 0 is a level floor; else it is that of a
/// first camera that was held upright, or again a map frame whose origin is anywhere.
std::optional<Ground> search_without_hint(std::span<const Vec3> points, const GroundParameters& parameters) {
  const auto map = search(points, kMapFrame, parameters);
  if (map && map->floor && std::abs(map->plane.offset_m) <= kOriginOnFloor_m) return map;
  const auto camera = search(points, kCameraFrame, parameters);
  if (!map || !camera) return map ? map : camera;
  if (map->floor != camera->floor) return map->floor ? map : camera;
  return !camera->floor && map->area_m2 > camera->area_m2 ? map : camera;
}

}  // namespace

Ground find_ground(const LabelledCloud& cloud, const std::optional<UpHint>& hint,
                   const GroundParameters& parameters) {
  std::vector<Vec3> points;
  points.reserve(cloud.size());
  for (const LabelledPoint& p : cloud)
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) points.push_back({p.x, p.y, p.z});
  const auto ground = hint ? search(points, *hint, parameters) : search_without_hint(points, parameters);
  if (ground && (ground->floor || !parameters.require_floor)) return *ground;
  std::ostringstream message;
  if (ground)
    message << "no floor is seen (" << ground->source << ", " << ground->area_m2 << " m2)";
  else
    message << "no ground found: no plane of " << parameters.min_area_m2 << " m2 or more "
            << (hint ? "across the upward direction (" + hint->source + ")"
                     : std::string("that could be a floor"))
            << " in a cloud of " << cloud.size() << " points";
  message << "; give the plane by hand: ground = \"nx ny nz d\" with nx x + ny y + nz z + d = 0, normal up";
  throw std::runtime_error(message.str());
}

Plane parse_plane(const std::string& text) {
  std::istringstream stream(text);
  Plane plane;
  std::string more;
  stream >> plane.normal.x >> plane.normal.y >> plane.normal.z >> plane.offset_m;
  const double length = norm(plane.normal);
  if (!stream || stream >> more || !(length > 0) || !std::isfinite(length) || !std::isfinite(plane.offset_m))
    throw contract::UsageError(
        "ground: expected \"nx ny nz d\", four numbers with a normal other than zero, found \"" + text +
        "\"");
  return {plane.normal / length, plane.offset_m / length};
}

}  // namespace sediment::project2d
