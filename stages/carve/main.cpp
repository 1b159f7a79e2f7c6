#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/carve/carve_sequence.hpp"

using namespace sediment;
using namespace sediment::contract;

int main(int argc, char** argv) {
  carve::Parameters parameters;
  int every_nth = 1;
  bool keep_removed = false;
  PcdEncoding encoding = PcdEncoding::binary;
  Stage stage("carve", "Removes points that other frames see through: what was there only for a while");
  stage.reads("cloud", kind::kCloud, "cloud to carve");
  stage.reads("sequence", kind::kSequence, "depth images that look through it");
  stage.reads("trajectory", kind::kTrajectory, "camera poses, in the world of the cloud");
  stage.reads_optional("dynamic", kind::kDynamicMasks, "what moves hides and shows nothing that stays");
  stage.writes("cloud", kind::kCloud, "the points that stay; removed.pcd beside it if asked for");
  stage.tunes("every_nth", every_nth, "every n-th frame looks", {1, 1e6});
  stage.tunes("noise", parameters.noise, "deviation of a depth at 1 m, metres; grows with its square",
              {0, 1});
  stage.tunes("sigmas", parameters.sigmas, "of the noise that a depth may be off", {0, 100});
  stage.tunes("slack_m", parameters.slack_m, "metres more, for the poses", {0, 10});
  stage.tunes("min_depth_m", parameters.min_depth_m, "nearer points are not judged by a frame", {0, 1000});
  stage.tunes("max_depth_m", parameters.max_depth_m, "farther points are not judged by a frame", {0, 1000});
  stage.tunes("window_px", parameters.window_px, "reach of the window that must be seen through as a whole",
              {0, 50});
  stage.tunes("min_views", parameters.min_views, "frames that must see through a point", {1, 60000});
  stage.tunes("min_share", parameters.min_share,
              "of the frames that tell something about a point, more than this must see through it", {0, 1});
  stage.tunes("min_confirmed", parameters.min_confirmed,
              "of the frames whose very pixel shows a point, or what is behind it, fewer make it go", {0, 1});
  stage.tunes(
      "max_person_share", parameters.max_person_share,
      "of the frames whose very pixel shows a point, more that take it for a person make it go; 1: never",
      {0, 1});
  stage.tunes("settle", parameters.settle,
              "move points to where the frames that see them have them in the mean, weighted by the noise");
  stage.tunes("keep_removed", keep_removed, "write what was cut as removed.pcd");
  stage.tunes("encoding", encoding, "of cloud.pcd",
              {{"ascii", PcdEncoding::ascii},
               {"binary", PcdEncoding::binary},
               {"binary-compressed", PcdEncoding::binary_compressed}});
  return stage.run(argc, argv, [&](Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const Trajectory trajectory = read_trajectory(work.in("trajectory"));
    std::optional<DynamicMasksReader> dynamic;
    if (work.has("dynamic")) dynamic.emplace(work.in("dynamic"));
    const LabelledCloud cloud = read_cloud(work.in("cloud"));
    Progress progress(
        "carve",
        (sequence.size() + static_cast<std::size_t>(every_nth) - 1) / static_cast<std::size_t>(every_nth),
        "frames");
    const carve::Carved carved = carve::carve_cloud(cloud, sequence, trajectory, dynamic, every_nth,
                                                    parameters, [&] { progress.advance(); });
    write_cloud(work.out(), carved.kept, read_cloud_labels(work.in("cloud")), encoding);
    if (keep_removed) write_pcd(work.out() / "removed.pcd", carved.removed, encoding);
    work.metrics() = {{"points_read", cloud.size()},
                      {"points_written", carved.kept.size()},
                      {"points_removed", carved.removed.size()},
                      {"points_never_seen", carved.statistics.never_seen},
                      {"points_spared", carved.statistics.spared},
                      {"views", carved.statistics.views},
                      {"frames_without_pose", carved.statistics.frames_without_pose}};
  });
}
