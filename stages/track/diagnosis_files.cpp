#include "stages/track/diagnosis_files.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "stages/track/diagnosis.hpp"
#include "stages/track/diagnosis_pictures.hpp"

namespace sediment::track {

void write_summary(const std::filesystem::path& file, const Tracked& tracked) {
  std::ofstream out(file, std::ios::binary);
  out << summary_of(tracked);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

void write_segments(const std::filesystem::path& folder, const std::vector<Trajectory>& apart) {
  if (apart.empty()) return;
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < apart.size(); ++i)
    write_tum_trajectory(folder / (std::to_string(i + 1) + ".txt"), apart[i]);
}

void write_diagnostics(const std::filesystem::path& folder, const Recording& recording,
                       const Diagnosis& diagnosis) {
  constexpr std::size_t kMost = 40;
  std::filesystem::create_directories(folder);
  const std::size_t keyframes = diagnosis.keyframes.size(), drawn = std::min(keyframes, kMost);
  for (std::size_t i = 0; i < drawn; ++i) {
    const KeyframeFeatures& keyframe = diagnosis.keyframes[i * keyframes / drawn];
    const cv::Mat dynamic = recording.dynamic_mask ? recording.dynamic_mask(keyframe.frame_idx) : cv::Mat();
    write_png(folder / (recording.stamps[keyframe.frame_idx] + ".png"),
              features_picture(recording.frame(keyframe.frame_idx).color, dynamic, keyframe));
  }
  write_png(folder / "residuals.png", residuals_picture(diagnosis));
}

}  // namespace sediment::track
