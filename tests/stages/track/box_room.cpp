#include "tests/stages/track/box_room.hpp"

#include <algorithm>
#include <cmath>

#include "stages/track/registration.hpp"

namespace sediment::track::test {
namespace {

constexpr double kHalf[3] = {2.5, 1.5, 3.0};

std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x9E3779B1u ^ b * 0x85EBCA77u ^ c * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

// Grey value of a place (metres) on one of the six walls.
int texture(int wall, double a, double b) {
  double value = 40;
  for (const double patch_m : {0.9, 0.23, 0.07}) {
    const auto i = static_cast<std::uint32_t>(std::floor(a / patch_m) + 1000);
    const auto j = static_cast<std::uint32_t>(std::floor(b / patch_m) + 1000);
    value += hash(i, j, static_cast<std::uint32_t>(wall * 7 + patch_m * 100)) % 65;
  }
  return static_cast<int>(value);
}

// Distance along a ray from inside the room to its wall, and the wall's grey value there.
double cast(Vec3 origin, Vec3 direction, int& grey) {
  const double o[3] = {origin.x, origin.y, origin.z}, d[3] = {direction.x, direction.y, direction.z};
  double nearest = 1e9;
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d[i]) < 1e-12) continue;
    const double t = ((d[i] > 0 ? kHalf[i] : -kHalf[i]) - o[i]) / d[i];
    if (t < nearest) {
      nearest = t;
      axis = i;
    }
  }
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  grey = texture(axis * 2 + (d[axis] > 0), o[a] + nearest * d[a] + 10, o[b] + nearest * d[b] + 10);
  return nearest;
}

Frame render(const Pose& world_from_camera, const Camera& camera, const Trouble& trouble,
             std::size_t frame_idx) {
  Frame frame;
  frame.frame_idx = frame_idx;
  frame.color = cv::Mat(camera.height, camera.width, CV_8UC3);
  frame.depth = cv::Mat(camera.height, camera.width, CV_16UC1);
  const bool black = trouble.black && trouble.black(frame_idx);
  const bool no_depth = trouble.no_depth && trouble.no_depth(frame_idx);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      int sum = 0, grey = 0;  // four rays a pixel, so that edges are not jagged
      for (const double du : {-0.25, 0.25})
        for (const double dv : {-0.25, 0.25}) {
          const Pixel ray = camera.undistort({u + du, v + dv});
          cast(world_from_camera.translation, world_from_camera.rotate({ray.u, ray.v, 1}), grey);
          sum += grey;
        }
      const Pixel ray = camera.undistort({double(u), double(v)});
      double z = cast(world_from_camera.translation, world_from_camera.rotate({ray.u, ray.v, 1}), grey);
      const auto draw = hash(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v),
                             static_cast<std::uint32_t>(frame_idx));
      const double noise = (draw % 2001 / 1000.0 - 1) * std::sqrt(3.0);  // uniform, deviation 1
      z = 1 / (1 / z + trouble.depth_noise * noise);
      const auto value = static_cast<std::uint8_t>(black ? 0 : sum / 4);
      frame.color.at<cv::Vec3b>(v, u) = {value, value, value};
      frame.depth.at<std::uint16_t>(v, u) =
          no_depth ? 0 : static_cast<std::uint16_t>(std::lround(z * camera.depth_scale));
    }
  return frame;
}

}  // namespace

Recording record_box_room(const std::vector<Pose>& world_from_camera, const Camera& camera,
                          const Trouble& trouble, double frame_period_s) {
  Recording recording;
  recording.camera = camera;
  for (std::size_t i = 0; i < world_from_camera.size(); ++i) {
    recording.stamps_s.push_back(100 + static_cast<double>(i) * frame_period_s);
    recording.stamps.push_back(std::to_string(recording.stamps_s.back()));
  }
  recording.frame = [=](std::size_t i) { return render(world_from_camera[i], camera, trouble, i); };
  if (trouble.masked)
    recording.dynamic_mask = [=](std::size_t i) {
      return cv::Mat(camera.height, camera.width, CV_8UC1,
                     cv::Scalar(trouble.masked(i) ? kPriorDynamic : kStatic));
    };
  return recording;
}

Camera small_camera() {
  Camera camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = 267.7;
  camera.fy = 269.6;
  camera.cx = 159.8;
  camera.cy = 123.6;
  return camera;
}

std::vector<Pose> swaying_poses(std::size_t frames, double metres, double radians) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / 30;
    Pose pose = rotation_from(
        {0.3 * radians * std::sin(2.1 * t), radians * std::sin(1.3 * t), 0.4 * radians * std::sin(1.7 * t)});
    pose.translation = {metres * std::sin(1.1 * t), 0.5 * metres * std::sin(1.9 * t),
                        metres * (1 - std::cos(0.9 * t))};
    poses.push_back(pose);
  }
  return poses;
}

double position_error_m(const Tracked& tracked, const std::vector<Pose>& truth) {
  std::vector<Vec3> estimated, true_positions;
  for (std::size_t i = 0; i < tracked.frames.size(); ++i) {
    if (tracked.frames[i].state == TrackingState::lost) continue;
    estimated.push_back(tracked.poses[estimated.size()].world_from_camera.translation);
    true_positions.push_back(truth[i].translation);
  }
  const Pose truth_from_estimated = rigid_alignment(estimated, true_positions);
  double sum = 0;
  for (std::size_t i = 0; i < estimated.size(); ++i) {
    const Vec3 error = truth_from_estimated * estimated[i] - true_positions[i];
    sum += dot(error, error);
  }
  return std::sqrt(sum / static_cast<double>(estimated.size()));
}

}  // namespace sediment::track::test
