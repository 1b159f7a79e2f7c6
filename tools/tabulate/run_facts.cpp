#include "tools/tabulate/run_facts.hpp"

#include <algorithm>

#include "pipeline/artifacts/file_bytes.hpp"

namespace sediment::tabulate {
namespace {

using Json = nlohmann::json;

StageFacts stage_from(const Json& json) {
  StageFacts stage;
  stage.key = json.at("key");
  stage.folder = json.at("folder").get<std::string>();
  for (const Json& output : json.at("outputs")) stage.kinds.push_back(output.at(1));
  for (const Json& file : json.at("files")) stage.files[file.at(0)] = file.at(1);
  stage.params = json.at("params");
  stage.metrics = json.at("metrics");
  stage.wall_s = json.at("wall_s");
  stage.peak_bytes = json.at("peak_bytes");
  return stage;
}

InstanceFacts instance_from(const Json& json) {
  InstanceFacts instance;
  instance.name = json.at("name");
  for (const Json& pair : json.at("values")) instance.values[pair.at(0)] = pair.at(1);
  for (const Json& one : json.at("stages")) {
    const std::string name = one.at("name");
    instance.order.push_back(name);
    instance.stages[name] = stage_from(one);
    for (const Json& input : one.at("inputs"))
      if (input.at("role") == "sequence" && input.contains("source"))
        instance.sequence = input.at("source").get<std::string>();
  }
  return instance;
}

}  // namespace

const StageFacts* InstanceFacts::last_with(const std::string& kind) const {
  for (auto last = order.rbegin(); last != order.rend(); ++last) {
    const StageFacts& stage = stages.at(*last);
    if (std::find(stage.kinds.begin(), stage.kinds.end(), kind) != stage.kinds.end()) return &stage;
  }
  return nullptr;
}

double InstanceFacts::wall_s() const {
  double sum = 0;
  for (const auto& [stage_name, stage] : stages) sum += stage.wall_s;
  return sum;
}

std::uint64_t InstanceFacts::peak_bytes() const {
  std::uint64_t most = 0;
  for (const auto& [stage_name, stage] : stages) most = std::max(most, stage.peak_bytes);
  return most;
}

RunFacts read_run_facts(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(read_bytes(file));
    if (json.at("format") != "sediment-report-facts 1")
      throw std::runtime_error(file.string() + ": unknown format " + json.at("format").dump());
    RunFacts facts;
    facts.name = json.at("name");
    for (const Json& one : json.at("instances")) {
      facts.instances.push_back(instance_from(one));
      for (const Json& pair : one.at("values"))
        if (std::find(facts.axes.begin(), facts.axes.end(), pair.at(0)) == facts.axes.end())
          facts.axes.push_back(pair.at(0));
    }
    return facts;
  } catch (const Json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace sediment::tabulate
