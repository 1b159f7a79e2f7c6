#include "stages/fuse/fuse_sequence.hpp"

#include <tbb/parallel_pipeline.h>

#include <set>
#include <stdexcept>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "stages/fuse/covered_cells.hpp"

namespace sediment::fuse {
namespace {

/// What one frame adds to the map.
struct Piece {
  LabelledCloud points;
  PixelCounts counts;
};

/// Adds the frames that are not among those selected, behind them.
void append_others(const Selection& all, Selection& selection) {
  std::set<std::size_t> known;
  for (const PosedFrame& frame : selection.frames) known.insert(frame.frame_idx);
  for (const PosedFrame& frame : all.frames)
    if (!known.contains(frame.frame_idx)) selection.frames.push_back(frame);
}

/// The first `selected` frames are the selected ones; those behind them fill.
Selection selection_of(const Sequence& sequence, const std::filesystem::path& trajectory,
                       const Parameters& parameters, std::size_t& selected) {
  std::vector<FrameStamp> stamps;
  for (std::size_t i = 0; i < sequence.size(); ++i)
    stamps.push_back({sequence.entry(i).stamp, sequence.entry(i).stamp_s});
  const bool by_keyframes = parameters.frames == FrameChoice::keyframes;
  const Trajectory poses = read_trajectory(trajectory);
  Selection selection = select_frames(stamps, poses, by_keyframes ? read_keyframes(trajectory) : Trajectory{},
                                      parameters.frames, parameters.every_nth);
  selected = selection.frames.size();
  if (parameters.fill_m > 0) append_others(select_frames(stamps, poses, {}, FrameChoice::all, 1), selection);
  return selection;
}

/// Reads and back-projects single frames; safe to call from several threads.
class FrameSource {
 public:
  FrameSource(const Sequence& sequence, const Sources& sources, const LabelTable& labels,
              const Projection& projection)
      : sequence_(sequence), labels_(labels), projection_(projection), rays_(rays_of(sequence.camera())) {
    if (sources.masks) masks_.emplace(*sources.masks);
    if (sources.dynamic) dynamic_.emplace(*sources.dynamic);
  }

  Piece operator()(const PosedFrame& posed) const {
    const std::string& stamp = sequence_.entry(posed.frame_idx).stamp;
    const Frame frame = sequence_.frame(posed.frame_idx);
    const View view{frame.color, frame.depth, masks_ ? masks_->read(stamp) : InstanceMask{},
                    dynamic_ ? dynamic_->read(stamp) : cv::Mat{}, posed.world_from_camera};
    Piece piece;
    try {
      piece.counts = back_project(view, sequence_.camera(), rays_, labels_, projection_, piece.points);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error("frame " + stamp + ": " + error.what());
    }
    return piece;
  }

 private:
  const Sequence& sequence_;
  const LabelTable& labels_;
  Projection projection_;
  std::vector<Ray> rays_;
  std::optional<MasksReader> masks_;
  std::optional<DynamicMasksReader> dynamic_;
};

[[noreturn]] void fail_empty(const FuseResult& result) {
  throw std::runtime_error(
      "no point for the map: of " + std::to_string(result.frames_fused + result.frames_without_pose.size()) +
      " selected frames " + std::to_string(result.frames_without_pose.size()) + " have no pose; of " +
      std::to_string(result.pixels.visited) + " pixels visited " + std::to_string(result.pixels.dynamic) +
      " are dynamic and " + std::to_string(result.pixels.out_of_range) + " have no depth in the range");
}

}  // namespace

FuseResult fuse_sequence(const Sequence& sequence, const Sources& sources, const LabelTable& labels,
                         const Parameters& parameters, std::size_t frames_in_flight,
                         const std::filesystem::path& out, const std::function<void(std::size_t)>& on_frame) {
  std::size_t selected = 0;
  const Selection selection = selection_of(sequence, sources.trajectory, parameters, selected);
  const FrameSource source(sequence, sources, labels, parameters.projection);
  Projection filling = parameters.projection;
  filling.pixel_step = parameters.fill_step;
  const FrameSource filling_source(sequence, sources, labels, filling);
  CloudWriter writer(out, parameters.encoding);
  FuseResult result;
  result.frames_fused = selected;
  result.frames_filling = selection.frames.size() - selected;
  result.frames_without_pose = selection.without_pose;
  CoveredCells covered(parameters.fill_m > 0 ? parameters.fill_m : 1);
  std::size_t appended = 0;

  std::size_t next = 0;
  const auto number_frames =
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        if (next == selection.frames.size()) flow.stop();
        return next++;
      });
  const auto project = tbb::make_filter<std::size_t, Piece>(tbb::filter_mode::parallel, [&](std::size_t i) {
    return i < selected ? source(selection.frames[i]) : filling_source(selection.frames[i]);
  });
  const auto append = tbb::make_filter<Piece, void>(tbb::filter_mode::serial_in_order, [&](Piece piece) {
    if (appended++ >= selected) {
      covered.keep_new(piece.points);
      result.points_filling += piece.points.size();
    } else if (parameters.fill_m > 0) {
      covered.add(piece.points);
    }
    writer.append(piece.points);
    result.pixels += piece.counts;
    on_frame(selection.frames.size());
  });
  tbb::parallel_pipeline(frames_in_flight, number_frames & project & append);

  result.points = writer.size();
  if (result.points == 0) fail_empty(result);
  writer.finish(labels);
  return result;
}

}  // namespace sediment::fuse
