#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/track/diagnosis_files.hpp"
#include "stages/track/given_poses.hpp"
#include "stages/track/recording.hpp"
#include "stages/track/track.hpp"

namespace {

using namespace sediment;
namespace kind = contract::kind;

track::Tracked poses_given(const track::Recording& recording, contract::Work& work, double max_gap_s) {
  if (!work.has("poses")) throw contract::UsageError("engine given needs --poses FILE");
  const GroundTruth given = read_ground_truth(work.in("poses"));
  const track::Gaps gaps = track::gaps_of(given.trajectory, max_gap_s);
  work.metrics()["given_repeated"] = given.repeated;
  work.metrics()["given_gaps"] = gaps.count;
  work.metrics()["given_longest_gap_s"] = gaps.longest_s;
  track::Tracked result;
  result.frames =
      track::resample(given.trajectory, recording.stamps, recording.stamps_s, max_gap_s, result.poses);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  track::Parameters parameters;
  contract::Stage stage("track", "Camera trajectory from ORB features outside the dynamic masks");
  stage.reads("sequence", kind::kSequence, "the recording");
  stage.reads_optional("dynamic", kind::kDynamicMasks, "pixels to leave out");
  stage.reads_optional("poses", kind::kFile, "engine given: a trajectory in TUM format");
  stage.writes("trajectory", kind::kTrajectory, "a pose for every frame that could be tracked");
  stage.tunes("engine", parameters.engine, "track the images, or take the poses given",
              contract::Choices<track::Engine>{{"orb", track::Engine::orb}, {"given", track::Engine::given}});
  stage.tunes(
      "mode", parameters.mode, "poses from the whole recording, or each from its past alone",
      contract::Choices<track::Mode>{{"offline", track::Mode::offline}, {"causal", track::Mode::causal}});
  stage.tunes("features", parameters.features, "ORB features a frame", {100, 10000});
  stage.tunes("mask_halo_px", parameters.mask_halo_px, "no feature this close to a dynamic pixel", {0, 100});
  stage.tunes("still_features", parameters.still_features,
              "mode offline: features on dynamic pixels serve too, where the finished map finds that they "
              "hold still");
  stage.tunes("depth_max_m", parameters.depth_max_m, "depth beyond is not used, metres", {0.1, 1000});
  stage.tunes("depth_noise", parameters.depth_noise, "standard deviation of an inverse depth, 1/m",
              {1e-6, 1});
  stage.tunes("pixel_noise_px", parameters.pixel_noise_px,
              "standard deviation of a feature's position, pixels", {0.01, 10});
  stage.tunes(
      "passes", parameters.passes,
      "at most: of measuring and adjusting the map, until the timing of the sensor is settled; 0: none",
      {0, 20});
  stage.tunes("smoothing", parameters.smoothing,
              "mode offline: the noise of single poses is taken out of the motion of the camera");
  stage.tunes("min_coverage", parameters.min_coverage, "an error if a smaller share of the frames has a pose",
              {0, 1});
  stage.tunes("diagnostics", parameters.diagnostics,
              "also write diagnostics/: keyframes with their features, histograms of the residuals");
  stage.tunes("max_gap_s", parameters.max_gap_s, "engine given: longest gap that is interpolated, seconds",
              {0, 10});
  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    std::optional<DynamicMasksReader> masks;
    if (work.has("dynamic")) masks.emplace(work.in("dynamic"));
    const auto recording = track::recording_of(sequence, masks ? &*masks : nullptr);
    contract::Progress progress("track", sequence.size(), "frames");
    const auto result = parameters.engine == track::Engine::given
                            ? poses_given(recording, work, parameters.max_gap_s)
                            : track::track(recording, parameters, [&] { progress.advance(); });
    work.metrics()["frames"] = result.frames.size();
    work.metrics()["tracked"] = result.poses.size();
    work.metrics()["coverage"] = track::coverage(result.frames);
    work.metrics()["landmarks"] = result.landmarks;
    work.metrics()["segments"] = result.segments;
    work.metrics()["loops"] = result.loops;
    work.metrics()["still_landmarks"] = result.still_landmarks;
    work.metrics()["readout_s"] = result.timing.readout_s;
    work.metrics()["depth_lag_s"] = result.timing.depth_lag_s;
    track::require_coverage(result.frames, parameters.min_coverage);
    write_trajectory(work.out(), result.poses, result.frames);
    track::write_segments(work.out() / "segments", result.apart);
    track::write_summary(work.out() / "summary.txt", result);
    if (parameters.diagnostics)
      track::write_diagnostics(work.out() / "diagnostics", recording, result.diagnosis);
  });
}
