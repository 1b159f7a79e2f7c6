#include <tbb/parallel_pipeline.h>

#include <optional>

#include "pipeline/artifacts/cloud_writer.hpp"
#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/fuse/back_projection.hpp"
#include "stages/fuse/frame_selection.hpp"

using namespace sediment;
using namespace sediment::fuse;

namespace {

struct Parameters {
  FrameChoice frames = FrameChoice::keyframes;
  int every_nth = 5;
  Projection projection;
  PcdEncoding encoding = PcdEncoding::binary;
};

/// What one frame adds to the map.
struct Piece {
  LabelledCloud points;
  PixelCounts counts;
};

Selection selection_of(const Sequence& sequence, const contract::Work& work, const Parameters& parameters) {
  std::vector<FrameStamp> stamps;
  for (std::size_t i = 0; i < sequence.size(); ++i)
    stamps.push_back({sequence.entry(i).stamp, sequence.entry(i).stamp_s});
  const bool by_keyframes = parameters.frames == FrameChoice::keyframes;
  return select_frames(stamps, read_trajectory(work.in("trajectory")),
                       by_keyframes ? read_keyframes(work.in("trajectory")) : Trajectory{}, parameters.frames,
                       parameters.every_nth);
}

/// Reads and back-projects single frames; safe to call from several threads.
class FrameSource {
 public:
  FrameSource(const Sequence& sequence, const contract::Work& work, const Projection& projection)
      : sequence_(sequence), projection_(projection), rays_(rays_of(sequence.camera())) {
    if (work.has("masks")) masks_.emplace(work.in("masks"));
    if (work.has("dynamic")) dynamic_.emplace(work.in("dynamic"));
    labels_ = work.has("labels") ? read_labels(work.in("labels")) : default_labels();
  }

  const LabelTable& labels() const { return labels_; }

  Piece operator()(const PosedFrame& posed) const {
    const std::string& stamp = sequence_.entry(posed.frame_idx).stamp;
    Frame frame = sequence_.frame(posed.frame_idx);
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
  Projection projection_;
  std::vector<Ray> rays_;
  std::optional<MasksReader> masks_;
  std::optional<DynamicMasksReader> dynamic_;
  LabelTable labels_;
};

/// Frames are read and back-projected in parallel and appended in their order; only a few are in memory at a
/// time.
PixelCounts fuse_frames(const std::vector<PosedFrame>& frames, const FrameSource& source,
                        std::size_t in_flight, CloudWriter& writer) {
  PixelCounts total;
  std::size_t next = 0;
  contract::Progress progress("fuse", frames.size(), "frames");
  const auto number_frames =
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        if (next == frames.size()) flow.stop();
        return next++;
      });
  const auto project = tbb::make_filter<std::size_t, Piece>(tbb::filter_mode::parallel,
                                                            [&](std::size_t i) { return source(frames[i]); });
  const auto append =
      tbb::make_filter<Piece, void>(tbb::filter_mode::serial_in_order, [&](const Piece& piece) {
        writer.append(piece.points);
        total += piece.counts;
        progress.advance();
      });
  tbb::parallel_pipeline(in_flight, number_frames & project & append);
  return total;
}

[[noreturn]] void fail_empty(const Selection& selection, const PixelCounts& counts) {
  throw std::runtime_error(
      "no point for the map: of " + std::to_string(selection.frames.size() + selection.without_pose.size()) +
      " selected frames " + std::to_string(selection.without_pose.size()) + " have no pose; of " +
      std::to_string(counts.visited) + " pixels visited " + std::to_string(counts.dynamic) +
      " are dynamic and " + std::to_string(counts.out_of_range) + " have no depth in the range");
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  Projection& projection = parameters.projection;
  contract::Stage stage("fuse",
                        "Back-projects the static pixels of the selected frames into one semantic cloud");
  stage.reads("sequence", contract::kind::kSequence, "colour and depth images");
  stage.reads("trajectory", contract::kind::kTrajectory, "camera poses and keyframes");
  stage.reads_optional("masks", contract::kind::kMasks, "instances: class colours, labels; without: none");
  stage.reads_optional("dynamic", contract::kind::kDynamicMasks,
                       "what moves and stays out; without: nothing moves");
  stage.reads_optional("labels", contract::kind::kFile,
                       "label table (YAML) of ids and colours; default: built in");
  stage.writes("cloud", contract::kind::kCloud, "points in the world frame");
  stage.tunes("frames", parameters.frames, "which frames go into the map",
              {{"keyframes", FrameChoice::keyframes},
               {"all", FrameChoice::all},
               {"every_nth", FrameChoice::every_nth}});
  stage.tunes("every_nth", parameters.every_nth, "n of frames=every_nth", {1, 1e6});
  stage.tunes("min_depth_m", projection.min_depth_m, "nearer pixels are left out", {0, 1000});
  stage.tunes("max_depth_m", projection.max_depth_m, "farther pixels are left out", {0, 1000});
  stage.tunes("pixel_step", projection.pixel_step, "every n-th pixel of every n-th row", {1, 1000});
  stage.tunes("blend", projection.blend, "share of the class colour in the colour of a labelled point",
              {0, 1});
  stage.tunes("encoding", parameters.encoding, "of cloud.pcd",
              {{"binary", PcdEncoding::binary},
               {"ascii", PcdEncoding::ascii},
               {"binary_compressed", PcdEncoding::binary_compressed}});

  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const Selection selection = selection_of(sequence, work, parameters);
    const FrameSource source(sequence, work, projection);
    CloudWriter writer(work.out(), parameters.encoding);
    const auto counts =
        fuse_frames(selection.frames, source, 2 * static_cast<std::size_t>(work.threads()), writer);
    if (writer.size() == 0) fail_empty(selection, counts);
    work.metrics() = {{"points", writer.size()},
                      {"frames_fused", selection.frames.size()},
                      {"frames_without_pose", selection.without_pose},
                      {"pixels_visited", counts.visited},
                      {"pixels_dynamic", counts.dynamic},
                      {"pixels_out_of_range", counts.out_of_range}};
    writer.finish(source.labels());
  });
}
