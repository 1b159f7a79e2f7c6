#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/opened_config.hpp"
#include "pipeline/runner/config/program.hpp"
#include "pipeline/runner/execution/process.hpp"
#include "pipeline/runner/execution/workspace.hpp"
#include "pipeline/runner/sweep/results.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::UsageError;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* kFactsFormat = "sediment-report-facts 1";
/// The program that reads artifacts and writes the page: the runner itself knows no clouds and no images.
constexpr const char* kReportProgram = "report";
constexpr int kReportLimit_s = 3600;

/// What a stage was given for a role, as its call has it: "--cloud PATH".
std::string path_in_call(const std::vector<std::string>& argv, const std::string& role) {
  const auto flag = std::find(argv.begin(), argv.end(), "--" + role);
  return flag == argv.end() || flag + 1 == argv.end() ? "" : *(flag + 1);
}

/// Where each input comes from: the stage that made this very content, else a source.
OrderedJson inputs_of(const Receipt& receipt, const InstanceResults& results) {
  OrderedJson inputs = OrderedJson::array();
  for (const auto& pair : receipt.parts.at("inputs")) {
    const std::string role = pair.at(0), id = pair.at(1);
    OrderedJson input = {{"role", role}, {"id", id}};
    for (const std::string& stage : results.stages)
      if (results.receipts.at(stage).object == id) input["stage"] = stage;
    if (!input.contains("stage")) input["source"] = path_in_call(receipt.argv, role);
    inputs.push_back(std::move(input));
  }
  return inputs;
}

OrderedJson facts_of(const std::string& stage, const InstanceResults& results, const StageRecord& record,
                     const Store& store) {
  const Receipt& receipt = results.receipts.at(stage);
  return {{"name", stage},
          {"state", record.state},
          {"why", receipt.why},
          {"key", receipt.key},
          {"object", receipt.object},
          {"folder", store.object_path(receipt.object).string()},
          {"bytes", receipt.bytes},
          {"files", receipt.files},
          {"params", receipt.parts.at("params")},
          {"inputs", inputs_of(receipt, results)},
          {"outputs", receipt.parts.at("outputs")},
          {"program", receipt.parts.at("exe")},
          {"argv", receipt.argv},
          {"wall_s", receipt.wall_s},
          {"cpu_s", receipt.cpu_s},
          {"peak_bytes", receipt.peak_bytes},
          {"host", receipt.host},
          {"started", receipt.started},
          {"accepted", receipt.accepted},
          {"metrics", receipt.metrics}};
}

OrderedJson facts_of(const InstanceResults& results, const fs::path& out, const Store& store) {
  const fs::path folder = results.point.name.empty() ? out : out / results.point.name;
  const RunRecord record = Workspace(folder).read_record();
  OrderedJson instance = {{"name", results.point.name},
                          {"values", results.point.values},
                          {"folder", folder.string()},
                          {"stages", OrderedJson::array()},
                          {"missing", OrderedJson::array()}};
  for (const std::string& stage : results.stages)
    instance["stages"].push_back(facts_of(stage, results, record.stages.at(stage), store));
  for (const auto& [stage, one] : record.stages)
    if (!results.receipts.contains(stage))
      instance["missing"].push_back({{"name", stage}, {"state", one.state}, {"why", one.why}});
  return instance;
}

void write_json(const fs::path& file, const OrderedJson& json) {
  std::ofstream stream(file, std::ios::binary);
  stream << json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

/// A file that vanishes.
struct FactsFile {
  fs::path path;
  FactsFile(const fs::path& folder, const OrderedJson& json)
      : path(folder / (".report." + std::to_string(getpid()) + ".json")) {
    write_json(path, json);
  }
  FactsFile(const FactsFile&) = delete;
  FactsFile& operator=(const FactsFile&) = delete;
  ~FactsFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

}  // namespace

int report(const Arguments& arguments) {
  const fs::path out = fs::absolute(arguments.config).lexically_normal();
  Arguments call = arguments;
  call.config.clear();
  call.out = out;
  read_points(out);  // says best what is wrong with a folder without results
  const Store store(store_of(call));
  const auto results = read_results(out, store);
  if (std::all_of(results.begin(), results.end(), [](const auto& one) { return one.receipts.empty(); }))
    throw UsageError(out.string() + " has no results");
  OrderedJson facts = {
      {"format", kFactsFormat},
      {"version", SEDIMENT_VERSION},
      {"name", out.has_filename() ? out.filename().string() : out.parent_path().filename().string()},
      {"folder", out.string()},
      {"instances", OrderedJson::array()}};
  for (const InstanceResults& one : results) facts["instances"].push_back(facts_of(one, out, store));
  if (!arguments.facts.empty()) {
    write_json(arguments.facts, facts);
    return contract::kDone;
  }
  const fs::path program = own_folder() / kReportProgram;
  if (!fs::exists(program)) throw UsageError(program.string() + " is missing: build the tools as well");
  const fs::path page =
      arguments.page.empty() ? out / "report.html" : fs::absolute(arguments.page).lexically_normal();
  const FactsFile file(out, facts);
  fmt::print("{}", output_of({program.string(), file.path.string(), "--out", page.string(), "--points",
                              std::to_string(arguments.points), "--frames", std::to_string(arguments.frames)},
                             kReportLimit_s));
  return contract::kDone;
}

}  // namespace sediment::runner
