// evaluate-masks: dynamic masks or instances against the truth.
#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/contract/errors.hpp"
#include "tools/entry/run_tool.hpp"
#include "tools/evaluate-masks/masks_text.hpp"

using namespace sediment;

namespace {

struct Call {
  std::filesystem::path truth, masks, plot, instances;
  bool json = false;
};

void print(const Call& call, const auto& evaluation) {
  std::cout << (call.json ? tools::to_json(evaluation).dump(1) + "\n" : tools::to_text(evaluation));
}

/// Images of 16 bits are instances, of 8 bits what moves.
bool holds_instances(const tools::MaskFolder& folder) {
  return probe_image(folder.file_of(folder.stamps().front())).bits == 16;
}

void run(const Call& call) {
  const tools::MaskFolder truth(call.truth), masks(call.masks);
  if (holds_instances(truth)) {
    if (!masks.has_instances())
      throw contract::UsageError(call.masks.string() +
                                 ": the truth holds instances, but these masks have none");
    if (!call.plot.empty()) throw contract::UsageError("--plot is for dynamic masks");
    return print(call, tools::evaluate_instances(tools::InstanceTruth(call.truth), MasksReader(call.masks),
                                                 truth.stamps()));
  }
  const auto instances = call.instances.empty() ? tools::InstanceTruth::beside(call.truth)
                                                : std::optional(tools::InstanceTruth(call.instances));
  const tools::DynamicEvaluation evaluation = tools::evaluate_dynamic(truth, masks, instances);
  if (!call.plot.empty()) write_png(call.plot, tools::plot(evaluation));
  print(call, evaluation);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Dynamic masks, or the instances of a segmentation, against the truth.", "evaluate-masks");
  Call call;
  app.add_option("TRUTH_DIR", call.truth,
                 "true dynamic masks (8 bits) or true instances (16 bits): STAMP.png or masks/STAMP.png")
      ->required();
  app.add_option("MASKS_DIR", call.masks,
                 "what is to be judged: dynamic masks, or the masks of the stage segment")
      ->required();
  app.add_flag("--json", call.json, "print JSON instead of tables");
  app.add_option("--plot", call.plot, "picture of the figures over time (PNG)")->type_name("FILE");
  app.add_option("--instances", call.instances,
                 "true instances, for figures by class and mover; default: instances/ beside TRUTH_DIR")
      ->type_name("DIR");
  return tools::run_tool(app, argc, argv, [&] { run(call); });
}
