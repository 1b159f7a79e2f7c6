#include "tools/evaluate-trajectory/frame_count.hpp"

#include <stdexcept>

#include "pipeline/artifacts/text_table.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"

namespace sediment::tools {

FrameCount frames_of_list(const std::filesystem::path& list) {
  FrameCount count{0, list.filename().string()};
  read_rows(list, [&](const TextRow& row) {
    expect_number(row.columns[0], "timestamp");
    ++count.frames;
  });
  if (count.frames == 0) throw std::runtime_error(list.string() + ": lists no image");
  return count;
}

std::optional<FrameCount> known_frames(const std::filesystem::path& truth,
                                       const std::filesystem::path& estimate) {
  if (std::filesystem::exists(estimate.parent_path() / "tracking.json"))
    return FrameCount{read_tracking(estimate.parent_path()).size(), "tracking.json"};
  if (std::filesystem::exists(truth.parent_path() / "rgb.txt"))
    return frames_of_list(truth.parent_path() / "rgb.txt");
  return std::nullopt;
}

}  // namespace sediment::tools
