#include "pipeline/runner/slurm/order.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "pipeline/runner/slurm/frozen_graph.hpp"
#include "pipeline/runner/slurm/submission.hpp"

namespace sediment::runner::slurm {
namespace {

namespace fs = std::filesystem;
using contract::Json;

fs::path orders_file(const fs::path& folder, std::size_t array) {
  return folder / ("orders-" + std::to_string(array) + ".jsonl");
}

/// How the line of a task begins: it is found without parsing the others.
std::string line_begin(std::size_t index) {
  return std::to_string(index) + '\t';
}

/// Numbers the graphs in use, each once.
class Graphs {
 public:
  explicit Graphs(const Profile& profile) : profile_(profile) {}

  std::size_t number_of(const Graph& graph) {
    const auto [found, fresh] = numbers_.try_emplace(&graph, numbers_.size());
    if (!fresh) return found->second;
    Graph given = graph;
    for (PlannedStage& stage : given.stages) {
      programs_[stage.name] = stage.program;
      stage.resources.amounts = request_of(stage, profile_, 0).amounts;
    }
    lines_ += to_json(given).dump() + '\n';
    return found->second;
  }

  void write(const fs::path& folder) const {
    write_whole(folder / "programs.json", to_json(programs_).dump() + '\n');
    write_whole(folder / "graphs.jsonl", lines_);
  }

 private:
  const Profile& profile_;
  std::map<const Graph*, std::size_t> numbers_;
  FrozenPrograms programs_;
  std::string lines_;
};

Json json_of(const Element& element, const std::vector<Work>& works, const std::vector<Instance>& instances,
             Graphs& graphs) {
  std::map<std::size_t, Json> stages;  ///< by instance: [stage, work]
  for (const std::size_t w : element.works)
    for (const Place& place : works[w].places)
      stages[place.instance_idx].push_back({place.stage_idx, works[w].id});
  Json all = Json::array();
  for (const auto& [i, todo] : stages) {
    const Instance& instance = instances[i];
    Json paths = Json::array();
    for (const fs::path& path : instance.source_paths) paths.push_back(path.string());
    all.push_back({{"name", instance.name},
                   {"graph", graphs.number_of(*instance.graph)},
                   {"out", instance.out.string()},
                   {"paths", paths},
                   {"ids", instance.source_ids},
                   {"stages", todo}});
  }
  return {{"amounts", element.request.amounts}, {"instances", all}};
}

Json read_json(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return Json::parse(stream);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(std::move(line));
  return lines;
}

/// Selects what is to be done; needed is also all that it reads.
Instance instance_from(const Json& json, std::shared_ptr<const Graph> graph,
                       std::vector<std::string>& works) {
  Instance instance;
  instance.name = json.at("name");
  instance.graph = std::move(graph);
  instance.out = json.at("out").get<std::string>();
  for (const Json& path : json.at("paths")) instance.source_paths.emplace_back(path.get<std::string>());
  instance.source_ids = json.at("ids").get<std::vector<std::string>>();
  const auto& stages = instance.graph->stages;
  instance.selected.assign(stages.size(), false);
  works.resize(stages.size());
  for (const Json& one : json.at("stages")) {
    instance.selected.at(one.at(0).get<std::size_t>()) = true;
    works[one.at(0).get<std::size_t>()] = one.at(1);
  }
  instance.needed = instance.selected;
  for (std::size_t s = stages.size(); s-- > 0;)
    for (const Input& input : stages[s].inputs)
      if (instance.needed[s] && input.stage_idx >= 0)
        instance.needed[static_cast<std::size_t>(input.stage_idx)] = true;
  return instance;
}

}  // namespace

void write_orders(const fs::path& folder, const std::vector<Array>& arrays,
                  const std::vector<Element>& elements, const std::vector<Work>& works,
                  const std::vector<Instance>& instances, const Manner& manner, const Profile& profile) {
  Graphs graphs(profile);
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    std::string lines;
    for (const auto& [index, e] : arrays[a].tasks)
      lines += line_begin(index) + json_of(elements[e], works, instances, graphs).dump() + '\n';
    write_whole(orders_file(folder, a), lines);
  }
  graphs.write(folder);
  const Json json = {{"jobs", manner.jobs},
                     {"threads", manner.threads},
                     {"durable", manner.durable},
                     {"check_space", manner.check_space}};
  write_whole(folder / "manner.json", json.dump() + '\n');
}

Order read_order(const fs::path& folder, std::size_t array, std::size_t index) {
  std::string line;
  std::ifstream stream(orders_file(folder, array), std::ios::binary);
  const std::string begin = line_begin(index);
  while (std::getline(stream, line) && !line.starts_with(begin)) line.clear();
  if (!line.starts_with(begin))
    throw std::runtime_error(folder.string() + " has no task " + std::to_string(index) + " of array " +
                             std::to_string(array));
  const Json json = Json::parse(line.substr(begin.size()));
  const Json manner = read_json(folder / "manner.json");
  Order order{{},
              {},
              json.at("amounts"),
              {manner.at("jobs"), manner.at("threads"), manner.at("durable"), manner.at("check_space")}};
  const FrozenPrograms programs = programs_from(read_json(folder / "programs.json"));
  const std::vector<std::string> lines = lines_of(folder / "graphs.jsonl");
  std::map<std::size_t, std::shared_ptr<const Graph>> graphs;
  for (const Json& one : json.at("instances")) {
    auto& graph = graphs[one.at("graph").get<std::size_t>()];
    if (!graph)
      graph = std::make_shared<const Graph>(
          graph_from(Json::parse(lines.at(one.at("graph").get<std::size_t>())), programs));
    order.works.emplace_back();
    order.instances.push_back(instance_from(one, graph, order.works.back()));
  }
  return order;
}

}  // namespace sediment::runner::slurm
