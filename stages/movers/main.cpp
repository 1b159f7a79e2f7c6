#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/movers/find_movers.hpp"

using namespace sediment;
using namespace sediment::movers;

int main(int argc, char** argv) {
  Parameters parameters;
  ContradictionParameters& contradiction = parameters.contradiction;
  contract::Stage stage("movers", "Finds what moves and no class names: what other frames see through");
  stage.reads("sequence", contract::kind::kSequence, "depth images");
  stage.reads("dynamic", contract::kind::kDynamicMasks, "what is known to move; it stays masked");
  stage.reads("trajectory", contract::kind::kTrajectory, "camera poses");
  stage.writes("dynamic", contract::kind::kDynamicMasks,
               "the same, and what was found (2 non-prior dynamic)");
  stage.tunes("reach_s", parameters.reach_s, "frames at most this far in time are compared", {0, 1e9});
  stage.tunes("views", parameters.views, "frames within that time that are asked", {1, 250});
  stage.tunes("noise", contradiction.noise, "deviation of a depth at 1 m, metres; grows with its square",
              {0, 1});
  stage.tunes("sigmas", contradiction.sigmas, "of the noise by which two depths may differ", {0, 100});
  stage.tunes("slack_m", contradiction.slack_m, "metres more, for the poses", {0, 10});
  stage.tunes("slack_rad", contradiction.slack_rad,
              "reach of the window that must be seen through as a whole", {0, 1});
  stage.tunes("lag_s", contradiction.lag_s,
              "between the instants of a pose and of a pixel; times the camera's speed it adds to the slack",
              {0, 1});
  stage.tunes("min_depth_m", contradiction.min_depth_m, "nearer pixels are not judged", {0, 1000});
  stage.tunes("max_depth_m", contradiction.max_depth_m, "farther pixels are not judged", {0, 1000});
  stage.tunes("min_views", parameters.regions.min_views, "frames that must see through a pixel", {1, 250});
  stage.tunes("min_share", parameters.regions.min_share,
              "of the frames that tell something about a pixel, more than this must see through it", {0, 1});
  stage.tunes("grow_share", parameters.regions.grow_share, "the same for pixels beside such ones", {0, 1});
  stage.tunes("min_area", parameters.regions.min_area, "of the image; smaller regions are speckle", {0, 1});
  stage.tunes("min_witnesses", parameters.min_witnesses,
              "of the two frames before and the two after, that must show a region too", {0, 4});
  stage.tunes("margin", parameters.margin, "frames by which what is found is masked longer, before and after",
              {0, 100});
  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const DynamicMasksReader dynamic(work.in("dynamic"));
    const Trajectory trajectory = read_trajectory(work.in("trajectory"));
    DynamicMasksWriter writer(work.out());
    contract::Progress progress("movers", sequence.size(), "frames");
    const Counts counts =
        find_movers(sequence, dynamic, trajectory, parameters, writer, [&] { progress.advance(); });
    work.metrics() = {{"frames", sequence.size()},
                      {"frames_without_pose", counts.frames_without_pose},
                      {"frames_with_movers", counts.frames_with_movers},
                      {"references", counts.references},
                      {"pixels_added", counts.pixels_added}};
  });
}
