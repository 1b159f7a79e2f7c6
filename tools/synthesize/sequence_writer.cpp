#include "tools/synthesize/sequence_writer.hpp"

#include <spdlog/fmt/fmt.h>
#include <tbb/parallel_for.h>

#include <fstream>
#include <stdexcept>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"

namespace sediment::synthetic {
namespace {

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

void write_lists(const Recording& recording, const std::filesystem::path& folder) {
  std::string color = "# color images\n# timestamp filename\n",
              depth = "# depth maps\n# timestamp filename\n";
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const std::string stamp = recording.stamp(i);
    color += fmt::format("{0} rgb/{0}.png\n", stamp);
    depth += fmt::format("{0} depth/{0}.png\n", stamp);
  }
  write_text(folder / "rgb.txt", color);
  write_text(folder / "depth.txt", depth);
}

void write_camera(const Recording& recording, const std::filesystem::path& folder) {
  const Camera& c = recording.camera();
  write_text(folder / "camera.txt",
             fmt::format("# fx fy cx cy width height depth_scale\n{} {} {} {} {} {} {}\n", c.fx, c.fy, c.cx,
                         c.cy, c.width, c.height, c.depth_scale));
  write_text(
      folder / "sequence.yaml",
      fmt::format(
          "root: .\ncamera: {{width: {}, height: {}, fx: {}, fy: {}, cx: {}, cy: {}, depth_scale: {}}}\n"
          "groundtruth: groundtruth.txt\naccelerometer: accelerometer.txt\n",
          c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.depth_scale));
}

void write_motion(const Recording& recording, const std::filesystem::path& folder) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < recording.size(); ++i)
    trajectory.push_back({recording.stamp(i), std::stod(recording.stamp(i)), recording.world_from_camera(i)});
  write_tum_trajectory(folder / "groundtruth.txt", trajectory);
  write_tum_trajectory(folder / "truth" / "groundtruth.txt", trajectory);
  std::string text =
      "# accelerometer: specific force in the camera frame (x right, y down, z forward), m/s^2; at rest it "
      "points up\n"
      "# timestamp ax ay az\n";
  constexpr double kRate = 100;
  const double first = trajectory.front().stamp_s, length = recording.time_s(recording.size() - 1);
  for (int i = 0; i <= static_cast<int>(length * kRate); ++i) {
    const Vec3 a = recording.accelerometer(i / kRate);
    text += fmt::format("{:.6f} {:.5f} {:.5f} {:.5f}\n", first + i / kRate, a.x, a.y, a.z);
  }
  write_text(folder / "accelerometer.txt", text);
}

}  // namespace

void write_recording(const Recording& recording, const std::filesystem::path& folder, const Extras& extras,
                     const std::function<void()>& written) {
  for (const char* name : {"rgb", "depth", "truth"}) std::filesystem::create_directories(folder / name);
  write_lists(recording, folder);
  write_camera(recording, folder);
  write_motion(recording, folder);
  TruthWriter truth(recording, folder / "truth", extras);
  tbb::parallel_for(std::size_t{0}, recording.size(), [&](std::size_t i) {
    const RecordedFrame f = recording.frame(i);
    write_png(folder / "rgb" / (f.frame.stamp + ".png"), f.frame.color);
    write_png(folder / "depth" / (f.frame.stamp + ".png"), f.frame.depth);
    truth.add(f);
    if (written) written();
  });
  truth.finish();
}

}  // namespace sediment::synthetic
