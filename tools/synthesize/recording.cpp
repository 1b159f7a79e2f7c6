#include "tools/synthesize/recording.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "tools/synthesize/color_sensor.hpp"
#include "tools/synthesize/depth_sensor.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

constexpr double kFirstStamp = 1000;  // seconds; a round number keeps stamps readable

Settings checked(Settings settings) {
  if (settings.width < 16 || settings.height < 16 || settings.width > 8192 || settings.height > 8192)
    throw std::invalid_argument("the image size must be 16 .. 8192 pixels a side");
  if (settings.frames < 0) throw std::invalid_argument("the number of frames must be above 0");
  if (!(settings.rate_hz > 0)) throw std::invalid_argument("the frame rate must be above 0");
  if (settings.frames == 0)
    for (const Title& title : titles())
      if (title.name == settings.scene) settings.frames = title.default_frames;
  return settings;
}

/// Boxes and ids of the instances in an image of body ids.
InstanceMask instances_of(const Scene& scene, const cv::Mat& bodies) {
  InstanceMask mask{cv::Mat(bodies.size(), CV_16UC1), {}};
  struct Extent {
    int left, top, right, bottom;
  };
  std::vector<Extent> found(scene.bodies.size() + 1, Extent{bodies.cols, bodies.rows, -1, -1});
  std::vector<bool> instance(scene.bodies.size() + 1, false);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) instance[i + 1] = scene.bodies[i].instance;
  for (int v = 0; v < bodies.rows; ++v) {
    const auto* row = bodies.ptr<std::uint16_t>(v);
    auto* ids = mask.ids.ptr<std::uint16_t>(v);
    for (int u = 0, end; u < bodies.cols; u = end) {  // runs of one body
      const std::uint16_t id = row[u];
      for (end = u + 1; end < bodies.cols && row[end] == id;) ++end;
      std::fill(ids + u, ids + end, instance[id] ? id : std::uint16_t{0});
      Extent& e = found[id];
      e = {std::min(e.left, u), std::min(e.top, v), std::max(e.right, end - 1), v};
    }
  }
  for (std::size_t id = 1; id < found.size(); ++id) {
    const Extent& e = found[id];
    if (!instance[id] || e.right < 0) continue;
    Instance seen;
    seen.id = static_cast<int>(id);
    seen.class_name = scene.bodies[id - 1].class_name;
    seen.box_px = {double(e.left), double(e.top), e.right + 1.0, e.bottom + 1.0};
    mask.instances.push_back(std::move(seen));
  }
  return mask;
}

/// What a hit on a solid means, whichever pixel it is in.
struct Meaning {
  std::uint16_t body;  ///< id
  std::uint8_t dynamic;
  std::array<float, kFaces> depth_loss;
};
std::vector<Meaning> meanings_of(const Scene& scene, const Moment& moment) {
  std::vector<Meaning> meanings;
  for (const PlacedSolid& placed : moment.solids) {
    const auto body_idx = static_cast<std::size_t>(placed.body_idx);
    const bool person = scene.bodies[body_idx].mobility == Mobility::person;
    Meaning m{static_cast<std::uint16_t>(body_idx + 1), kStatic, {}};
    if (moment.moving[body_idx]) m.dynamic = person ? kPriorDynamic : kNonPriorDynamic;
    for (std::size_t face = 0; face < kFaces; ++face)
      m.depth_loss[face] =
          scene.materials[static_cast<std::size_t>(placed.solid->materials[face])].depth_loss;
    meanings.push_back(m);
  }
  return meanings;
}

}  // namespace

Camera camera_for(int width, int height) {
  Camera camera;
  const double scale = width / 640.0;
  camera.width = width, camera.height = height;
  camera.fx = 535.4 * scale, camera.fy = 539.2 * scale;
  // Pixel centres are at integers: the image's middle is at (width - 1) / 2.
  camera.cx = (width - 1) / 2.0 + 0.6 * scale, camera.cy = (height - 1) / 2.0 + 8.1 * scale;
  return camera;
}

Recording::Recording(const Settings& settings)
    : settings_(checked(settings)),
      camera_(camera_for(settings.width, settings.height)),
      play_(stage_play(settings_.scene, settings_.seed, settings_.frames / settings_.rate_hz,
                       0.9 / camera_.fx)),
      lighting_(play_.scene, 0.05 * std::max(1.0, 640.0 / settings.width / 2)),
      renderer_(camera_) {}

double Recording::time_s(std::size_t frame_idx) const {
  return static_cast<double>(frame_idx) / settings_.rate_hz;
}

std::string Recording::stamp(std::size_t frame_idx) const {
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", kFirstStamp + time_s(frame_idx));
  return text;
}

RecordedFrame Recording::frame(std::size_t frame_idx) const {
  const double t = time_s(frame_idx);
  const std::uint64_t frame_seed = hash(settings_.seed, 1000 + frame_idx);
  RecordedFrame out;
  out.frame.frame_idx = frame_idx;
  out.frame.stamp = stamp(frame_idx);
  out.frame.stamp_s = std::stod(out.frame.stamp);
  out.world_from_camera = play_.motion(t);
  out.moment = moment_of(play_.scene, t);
  const Moment& moment = out.moment;
  out.exact = renderer_.render(play_.scene, lighting_, moment, out.world_from_camera);

  cv::Mat bodies(out.exact.solid.size(), CV_16UC1, cv::Scalar(0)),
      loss(bodies.size(), CV_32FC1, cv::Scalar(0));
  out.dynamic = cv::Mat(bodies.size(), CV_8UC1, cv::Scalar(kStatic));
  const std::vector<Meaning> meanings = meanings_of(play_.scene, moment);
  for (int v = 0; v < bodies.rows; ++v) {
    const int* solids = out.exact.solid.ptr<int>(v);
    const auto* faces = out.exact.face.ptr(v);
    for (int u = 0; u < bodies.cols; ++u) {
      if (solids[u] < 0) continue;
      const Meaning& m = meanings[static_cast<std::size_t>(solids[u])];
      bodies.ptr<std::uint16_t>(v)[u] = m.body;
      out.dynamic.ptr(v)[u] = m.dynamic;
      loss.ptr<float>(v)[u] = m.depth_loss[faces[u]];
    }
  }
  const bool dark = is_dark(frame_idx);
  if (dark) bodies.setTo(0), out.dynamic.setTo(kStatic);
  out.instances = instances_of(play_.scene, bodies);

  out.frame.color = dark ? cv::Mat(bodies.size(), CV_8UC3, cv::Scalar::all(0)) : out.exact.color.clone();

  if (settings_.noise) {
    expose(out.frame.color, t, settings_.seed, hash(frame_seed, 1));
    out.frame.depth = measure_depth(out.exact.depth_m, loss, camera_, {}, hash(frame_seed, 2));
  } else {
    out.frame.depth = encode_depth(out.exact.depth_m, camera_);
  }
  if (dark) out.frame.depth.setTo(0);
  return out;
}

bool Recording::is_dark(std::size_t frame_idx) const {
  const double share = (static_cast<double>(frame_idx) + 0.5) / settings_.frames;
  return share > play_.blackout_from && share < play_.blackout_to;
}

}  // namespace sediment::synthetic
