// evaluate-map: clouds, octrees and grids against the truth of a sequence, or against a reference cloud.
#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/errors.hpp"
#include "tools/entry/run_tool.hpp"
#include "tools/evaluate-map/map_alignment.hpp"
#include "tools/evaluate-map/map_evaluation.hpp"

using namespace sediment;
namespace fs = std::filesystem;

namespace {

struct Call {
  fs::path truth, truth_folder, trajectory;
  std::vector<fs::path> maps;
  tools::MapRules rules;
  bool json = false, as_is = false;
};

void declare(CLI::App& app, Call& call) {
  app.add_option("TRUTH", call.truth,
                 "sequence (YAML or folder) with its truth, or a reference cloud (folder, PCD or PLY file)")
      ->required();
  app.add_option("MAP", call.maps, "folders of fuse, sor, voxel, octree, project2d, or PCD and PLY files")
      ->required();
  app.add_flag("--json", call.json, "print JSON instead of tables");
  app.add_option("--truth", call.truth_folder,
                 "folder with static_cloud, dynamic, instances; default: truth/ in the "
                 "root of the sequence")
      ->type_name("DIR");
  auto* trajectory =
      app.add_option("--trajectory", call.trajectory,
                     "trajectory the maps were made with, to bring them into the world of the truth; "
                     "default: track/ beside each map, if it is there")
          ->type_name("FILE");
  app.add_flag("--as-is", call.as_is, "the maps are in the world of the truth already")->excludes(trajectory);
  app.add_option("--threshold", call.rules.threshold_m, "metres up to which points agree")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--max-depth", call.rules.max_depth_m, "metres up to which dynamic pixels count")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--min-height", call.rules.band.low_m, "metres above the ground where obstacles begin")
      ->capture_default_str();
  app.add_option("--max-height", call.rules.band.high_m, "metres above the ground where obstacles end")
      ->capture_default_str();
}

tools::MapTruth open_truth(const Call& call) {
  if (tools::is_cloud(call.truth)) return {tools::read_any_cloud(call.truth), call.rules};
  return {tools::open_true_sequence(call.truth, call.truth_folder), call.rules};
}

tools::MapEvaluation evaluate(const Call& call, const tools::MapTruth& truth, const fs::path& map) {
  fs::path trajectory = call.trajectory;
  if (trajectory.empty() && !call.as_is && truth.sequence()) {
    const fs::path beside = fs::absolute(map).lexically_normal();
    const fs::path track = (beside.has_filename() ? beside : beside.parent_path()).parent_path() / "track";
    if (fs::exists(track / "trajectory.txt")) trajectory = track;
  }
  if (fs::is_directory(trajectory)) trajectory /= "trajectory.txt";
  if (!trajectory.empty() && !truth.sequence())
    throw contract::UsageError("--trajectory needs the truth of a sequence");
  const Pose truth_from_map =
      trajectory.empty() ? Pose{} : tools::truth_from_map(*truth.sequence(), read_tum_trajectory(trajectory));
  tools::MapEvaluation evaluation = tools::evaluate_map(truth, map, truth_from_map);
  evaluation.alignment = trajectory.empty() ? "as it is" : "aligned by " + trajectory.string();
  return evaluation;
}

void run(const Call& call) {
  if (call.rules.band.low_m >= call.rules.band.high_m)
    throw contract::UsageError("--min-height must be below --max-height");
  const tools::MapTruth truth = open_truth(call);
  nlohmann::ordered_json json = {{"format", "sediment-map-evaluation 1"}, {"truth", call.truth.string()}};
  for (const fs::path& map : call.maps) {
    const tools::MapEvaluation evaluation = evaluate(call, truth, map);
    json["maps"].push_back(tools::to_json(evaluation));
    if (!call.json) std::cout << tools::to_text(evaluation) << "\n";
  }
  if (call.json) std::cout << json.dump(1) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Clouds, octrees and navigation grids against the truth.", "evaluate-map");
  Call call;
  declare(app, call);
  return tools::run_tool(app, argc, argv, [&] { run(call); });
}
