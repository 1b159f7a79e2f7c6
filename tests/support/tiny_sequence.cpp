#include "tests/support/tiny_sequence.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"

namespace sediment::test {
namespace {

constexpr double kWall_m = 2;
constexpr double kDepthDelay_s = 0.004;

std::string stamp_text(double stamp_s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", stamp_s);
  return text;
}

/// Squares of 5 cm, each of a colour of its own.
cv::Vec3b wall_color(double x_m, double y_m) {
  const auto column = static_cast<std::uint32_t>(std::floor(x_m / 0.05) + 1000);
  const auto row = static_cast<std::uint32_t>(std::floor(y_m / 0.05) + 1000);
  const std::uint32_t mixed = (column * 2654435761u) ^ (row * 2246822519u);
  return {static_cast<std::uint8_t>(mixed >> 8), static_cast<std::uint8_t>(mixed >> 16),
          static_cast<std::uint8_t>(mixed >> 24)};
}

Frame frame_at(const Camera& camera, std::size_t frame_idx, double camera_x_m) {
  Frame frame;
  frame.frame_idx = frame_idx;
  frame.stamp = stamp_text(100 + 0.04 * static_cast<double>(frame_idx));
  frame.stamp_s = std::stod(frame.stamp);
  frame.color.create(camera.height, camera.width, CV_8UC3);
  frame.depth.create(camera.height, camera.width, CV_16UC1);
  frame.depth.setTo(kWall_m * camera.depth_scale);
  frame.depth.row(0).setTo(0);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 point = camera.back_project({static_cast<double>(u), static_cast<double>(v)}, kWall_m);
      frame.color.at<cv::Vec3b>(v, u) = wall_color(point.x + camera_x_m, point.y);
    }
  return frame;
}

}  // namespace

TinySequence tiny_sequence(int frame_count) {
  TinySequence sequence;
  sequence.camera = {64, 48, 60, 60, 31.5, 23.5, {}, 5000};
  for (int i = 0; i < frame_count; ++i) {
    const double x_m = 0.01 * i;
    sequence.frames.push_back(frame_at(sequence.camera, static_cast<std::size_t>(i), x_m));
    const Frame& frame = sequence.frames.back();
    sequence.groundtruth.push_back({frame.stamp, frame.stamp_s, pose_from({}, {x_m, 0, 0})});
  }
  return sequence;
}

std::filesystem::path write_sequence(const std::filesystem::path& folder, const TinySequence& sequence) {
  std::filesystem::create_directories(folder);
  std::ofstream color_list(folder / "rgb.txt"), depth_list(folder / "depth.txt");
  color_list << "# timestamp filename\n";
  depth_list << "# timestamp filename\n";
  for (const Frame& frame : sequence.frames) {
    const std::string color = "rgb/" + frame.stamp + ".png";
    const std::string depth_stamp = stamp_text(frame.stamp_s + kDepthDelay_s);
    const std::string depth = "depth/" + depth_stamp + ".png";
    color_list << frame.stamp << " " << color << "\n";
    depth_list << depth_stamp << " " << depth << "\n";
    write_png(folder / color, frame.color);
    write_png(folder / depth, frame.depth);
  }
  write_tum_trajectory(folder / "groundtruth.txt", sequence.groundtruth);
  const Camera& camera = sequence.camera;
  std::ofstream yaml(folder / "sequence.yaml");
  yaml.precision(17);
  yaml << "camera: {width: " << camera.width << ", height: " << camera.height << ", fx: " << camera.fx
       << ", fy: " << camera.fy << ", cx: " << camera.cx << ", cy: " << camera.cy << ", distortion: [";
  for (std::size_t i = 0; i < 5; ++i) yaml << (i == 0 ? "" : ", ") << camera.distortion[i];
  yaml << "], depth_scale: " << camera.depth_scale << "}\ngroundtruth: groundtruth.txt\n";
  return folder / "sequence.yaml";
}

}  // namespace sediment::test
