#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifacts/cloud_writer.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "stages/fuse/back_projection.hpp"
#include "stages/fuse/frame_selection.hpp"

namespace sediment::fuse {

struct Parameters {
  FrameChoice frames = FrameChoice::keyframes;
  int every_nth = 5;
  /// Frames that are not selected add only what no selected one saw: points that no earlier one is near, by
  /// cells of this side (CoveredCells). 0: they add nothing.
  double fill_m = 0;
  /// Their pixel_step: what only one of them sees is far or narrow, and needs every pixel.
  int fill_step = 1;
  Projection projection;
  PcdEncoding encoding = PcdEncoding::binary;
};

/// Folders of the artifacts to fuse.
struct Sources {
  std::filesystem::path trajectory;
  std::optional<std::filesystem::path> masks;    ///< without: nothing is labelled
  std::optional<std::filesystem::path> dynamic;  ///< without: nothing moves
};

struct FuseResult {
  std::uint64_t points = 0;
  std::size_t frames_fused = 0;
  std::size_t frames_filling = 0;                ///< that added what was missing
  std::uint64_t points_filling = 0;              ///< of them
  std::vector<std::string> frames_without_pose;  ///< stamps of selected frames that are left out
  PixelCounts pixels;
};

/// Fuses the selected frames and writes the `cloud` artifact into `out`. Frames are read and back-projected
/// in parallel and appended in their order; at most `frames_in_flight` are in memory at a time. `on_frame`
/// is told the number of frames once and returns what is called after each. Throws std::runtime_error that
/// names file and frame, also if there is no point at all: then it says where they went.
FuseResult fuse_sequence(const Sequence& sequence, const Sources& sources, const LabelTable& labels,
                         const Parameters& parameters, std::size_t frames_in_flight,
                         const std::filesystem::path& out, const std::function<void(std::size_t)>& on_frame);

}  // namespace sediment::fuse
