// evaluate-trajectory: errors of a camera trajectory against the truth, as TUM's tools and evo define them.
#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/errors.hpp"
#include "tools/entry/run_tool.hpp"
#include "tools/evaluate-trajectory/evaluation_plot.hpp"
#include "tools/evaluate-trajectory/evaluation_text.hpp"
#include "tools/evaluate-trajectory/evo_archive.hpp"
#include "tools/evaluate-trajectory/frame_count.hpp"

using namespace sediment;

namespace {

struct Call {
  std::filesystem::path truth, estimate, plot, csv, evo_ape, evo_rpe, frames;
  std::size_t sequence_frames = 0;
  bool json = false;
};

void declare(CLI::App& app, Call& call) {
  app.add_option("TRUTH", call.truth, "trajectory in TUM format, or a trajectory folder")->required();
  app.add_option("ESTIMATE", call.estimate, "trajectory in TUM format, or a trajectory folder (track/)")
      ->required();
  app.add_flag("--json", call.json, "print JSON instead of tables");
  app.add_option("--plot", call.plot, "picture of trajectory and errors (PNG)")->type_name("FILE");
  app.add_option("--csv", call.csv, "errors pose by pose")->type_name("FILE");
  app.add_option("--evo-ape", call.evo_ape, "evo's result archive of the aligned absolute error")
      ->type_name("ZIP");
  app.add_option("--evo-rpe", call.evo_rpe, "evo's result archive of the relative error over a frame")
      ->type_name("ZIP");
  auto* list =
      app.add_option("--frames", call.frames,
                     "list of the sequence's images (rgb.txt) for the coverage; default: tracking.json "
                     "beside ESTIMATE, else rgb.txt beside TRUTH");
  app.add_option("--sequence-frames", call.sequence_frames, "number of the sequence's frames")
      ->excludes(list)
      ->check(CLI::PositiveNumber);
}

/// A folder stands for the trajectory in it: of a stage, or of a sequence.
std::filesystem::path trajectory_file(const std::filesystem::path& given) {
  if (!std::filesystem::is_directory(given)) return given;
  return given / (std::filesystem::exists(given / "groundtruth.txt") ? "groundtruth.txt" : "trajectory.txt");
}

void run(const Call& call) {
  const auto truth_file = trajectory_file(call.truth), estimate_file = trajectory_file(call.estimate);
  const GroundTruth ground_truth = read_ground_truth(truth_file);
  const Trajectory &truth = ground_truth.trajectory, estimate = read_tum_trajectory(estimate_file);
  if (truth.empty()) throw std::runtime_error(truth_file.string() + ": holds no pose");
  if (estimate.empty()) throw std::runtime_error(estimate_file.string() + ": holds no pose");
  auto frames = tools::known_frames(truth_file, estimate_file);
  if (!call.frames.empty()) frames = tools::frames_of_list(call.frames);
  if (call.sequence_frames > 0) frames = tools::FrameCount{call.sequence_frames, "--sequence-frames"};
  const tools::Evaluation evaluation = tools::evaluate(ground_truth, estimate, frames);
  if (!call.plot.empty()) write_png(call.plot, tools::plot(evaluation, truth, estimate));
  if (!call.csv.empty()) write_bytes(call.csv, {tools::to_csv(evaluation, truth, estimate)});
  const std::string truth_name = truth_file.stem().string() + "_truth";
  const std::string estimate_name = estimate_file.stem().string() + "_estimate";
  if (!call.evo_ape.empty())
    tools::write_evo_ape(call.evo_ape, evaluation, truth, estimate, truth_name, estimate_name);
  if (!call.evo_rpe.empty())
    tools::write_evo_rpe(call.evo_rpe, evaluation, truth, estimate, truth_name, estimate_name);
  std::cout << (call.json ? tools::to_json(evaluation).dump(1) + "\n" : tools::to_text(evaluation));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Errors of a camera trajectory against the truth, as TUM's tools and evo define them.",
               "evaluate-trajectory");
  Call call;
  declare(app, call);
  return tools::run_tool(app, argc, argv, [&] { run(call); });
}
