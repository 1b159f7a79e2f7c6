#include <optional>

#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/fuse/fuse_sequence.hpp"

using namespace sediment;
using namespace sediment::fuse;

namespace {

std::optional<std::filesystem::path> given(const contract::Work& work, const std::string& role) {
  return work.has(role) ? std::optional(work.in(role)) : std::nullopt;
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
  stage.tunes(
      "fill_m", parameters.fill_m,
      "frames that are not selected add points that no earlier one is near, by cells of this side; 0: "
      "none",
      {0, 10});
  stage.tunes("fill_step", parameters.fill_step, "pixel_step of these frames", {1, 1000});
  stage.tunes("min_depth_m", projection.min_depth_m, "nearer pixels are left out", {0, 1000});
  stage.tunes("max_depth_m", projection.max_depth_m, "farther pixels are left out", {0, 1000});
  stage.tunes("pixel_step", projection.pixel_step, "every n-th pixel of every n-th row", {1, 1000});
  stage.tunes("blend", projection.blend, "share of the class colour in the colour of a labelled point",
              {0, 1});
  stage.tunes("max_incidence_deg", projection.max_incidence_deg,
              "pixels on steps of the depth, or on surfaces seen at a larger angle, are left out; 90: none",
              {1, 90});
  stage.tunes("noise", projection.noise, "deviation of a depth at 1 m, metres; grows with its square",
              {0, 1});
  stage.tunes("encoding", parameters.encoding, "of cloud.pcd",
              {{"binary", PcdEncoding::binary},
               {"ascii", PcdEncoding::ascii},
               {"binary_compressed", PcdEncoding::binary_compressed}});

  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const LabelTable labels = work.has("labels") ? read_labels(work.in("labels")) : default_labels();
    const Sources sources{work.in("trajectory"), given(work, "masks"), given(work, "dynamic")};
    std::optional<contract::Progress> progress;
    const auto on_frame = [&](std::size_t frames) {
      if (!progress) progress.emplace("fuse", frames, "frames");
      progress->advance();
    };
    const FuseResult result =
        fuse_sequence(sequence, sources, labels, parameters, 2 * static_cast<std::size_t>(work.threads()),
                      work.out(), on_frame);
    work.metrics() = {{"points", result.points},
                      {"frames_fused", result.frames_fused},
                      {"frames_filling", result.frames_filling},
                      {"points_filling", result.points_filling},
                      {"frames_without_pose", result.frames_without_pose},
                      {"pixels_visited", result.pixels.visited},
                      {"pixels_dynamic", result.pixels.dynamic},
                      {"pixels_out_of_range", result.pixels.out_of_range},
                      {"pixels_at_edges", result.pixels.at_edge}};
  });
}
