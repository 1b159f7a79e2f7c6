#include <fmt/format.h>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/look.hpp"
#include "pipeline/runner/commands/slurm_states.hpp"
#include "pipeline/runner/config/graph_text.hpp"
#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner {
namespace {

using contract::Json;
using State = PlannedTask::State;

int print_json(const Json& json) {
  fmt::print("{}\n", json.dump(1));
  return contract::kDone;
}

Json json_of(const LookedAt& one) {
  const PlannedTask& task = one.task;
  Json json = {{"stage", one.label},
               {"state", name_of(task.state)},
               {"why", task.why.text},
               {"argv", task.argv},
               {"key", task.key ? Json(task.key->id) : Json()},
               {"parts", task.key ? Json::parse(task.key->text) : Json()},
               {"object", task.hit ? Json(task.hit->object) : Json()},
               {"bytes", task.hit ? Json(task.hit->bytes) : Json()},
               {"differences", Json::array()}};
  for (const Difference& difference : task.why.differences)
    json["differences"].push_back(
        {{"part", difference.part}, {"before", difference.before}, {"after", difference.after}});
  return json;
}

Json json_of(const std::vector<const LookedAt*>& stages) {
  Json json = Json::array();
  for (const LookedAt* one : stages) json.push_back(json_of(*one));
  return json;
}

std::string state_in_status(const LookedAt& one, const Store& store) {
  if (one.task.state == State::kept) return "up to date";
  if (one.task.key && store.is_locked(one.task.key->id)) return "running";
  if (one.last && one.last->state == "failed") return "failed";
  return one.task.state == State::behind ? "may run" : "to run";
}

}  // namespace

int show_plan(const Arguments& arguments) {
  const Look all = look(arguments);
  if (arguments.json) return print_json(json_of(all.named("")));
  int kept = 0, runs = 0, behind = 0;
  for (const LookedAt& one : all.stages) {
    (one.task.state == State::kept ? kept : one.task.state == State::runs ? runs : behind) += 1;
    const std::string why = one.task.why.text.empty() ? "" : " (" + one.task.why.text + ')';
    fmt::print("{}: {}{}\n", one.label, name_of(one.task.state), why);
    if (one.task.state != State::kept) fmt::print("  {}\n", shell_text(one.task.argv));
  }
  fmt::print("{} kept, {} to run, {} behind them\n", kept, runs, behind);
  return contract::kDone;
}

int show_why(const Arguments& arguments) {
  const Look all = look(arguments);
  const auto stages = all.named(arguments.stage);
  if (arguments.json) return print_json(arguments.stage.empty() ? json_of(stages) : json_of(*stages.front()));
  for (const LookedAt* one : stages) {
    if (one->task.state == State::kept) {
      const bool known = one->last && !one->last->why.empty();
      fmt::print("{}: kept{}\n", one->label, known ? "; it last ran for: " + one->last->why : "");
      continue;
    }
    fmt::print("{}: {} ({})\n", one->label, name_of(one->task.state), one->task.why.text);
    for (const Difference& difference : one->task.why.differences) fmt::print("  {}\n", difference.text());
  }
  return contract::kDone;
}

int show_graph(const Arguments& arguments) {
  const OpenedConfig opened = open_config(arguments);
  const Graph& graph = *opened.instances.front().graph;
  if (arguments.json) return print_json(graph_json(graph));
  fmt::print("{}", graph_text(graph, arguments.format));
  return contract::kDone;
}

int show_status(const Arguments& arguments) {
  const Look all = look(arguments);
  const SlurmStates on_slurm = slurm_states(all);
  Json json = Json::array();
  std::vector<std::vector<std::string>> rows{{"stage", "state", "result", "why"}};
  for (const LookedAt& one : all.stages) {
    const auto known = on_slurm.by_place.find({one.instance_idx, one.stage_idx});
    const bool is_known = known != on_slurm.by_place.end();
    const std::string state = is_known ? known->second.state : state_in_status(one, *all.opened.store);
    const std::string why = is_known ? known->second.why : one.task.why.text;
    rows.push_back({one.label, state, one.task.hit ? shown_bytes(one.task.hit->bytes) : "-", why});
    if (!arguments.json) continue;
    json.push_back(json_of(one));
    json.back()["state"] = state;
    if (!is_known) continue;
    json.back()["why"] = why;
    json.back()["job"] = known->second.job;
  }
  if (arguments.json) return print_json(json);
  fmt::print("{}{}", aligned(rows, {2}), on_slurm.summary);
  return contract::kDone;
}

}  // namespace sediment::runner
