#include <fmt/format.h>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/look.hpp"
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

Json json_of(const Look& all, std::size_t idx) {
  const PlannedTask& task = all.tasks[idx];
  Json json = {{"stage", all.stage(idx).name},
               {"state", name_of(task.state)},
               {"why", task.why.text},
               {"argv", task.argv},
               {"key", task.key ? Json(task.key->id) : Json()},
               {"parts", task.key ? Json::parse(task.key->text) : Json()},
               {"object", task.hit ? Json(task.hit->object) : Json()},
               {"bytes", task.hit ? Json(task.hit->bytes) : Json()},
               {"differences", Json::array()}};
  for (const Difference& one : task.why.differences)
    json["differences"].push_back({{"part", one.part}, {"before", one.before}, {"after", one.after}});
  return json;
}

/// The stages that are looked at, as JSON.
Json json_of(const Look& all) {
  Json json = Json::array();
  for (std::size_t i = 0; i < all.tasks.size(); ++i)
    if (all.tasks[i].state != State::skipped) json.push_back(json_of(all, i));
  return json;
}

std::string state_in_status(const Look& all, std::size_t idx) {
  const PlannedTask& task = all.tasks[idx];
  const StageRecord* last = all.last_of(idx);
  if (task.state == State::kept) return "up to date";
  if (task.key && all.opened.store->is_locked(task.key->id)) return "running";
  if (last != nullptr && last->state == "failed") return "failed";
  return task.state == State::behind ? "may run" : "to run";
}

}  // namespace

int show_plan(const Arguments& arguments) {
  const Look all = look(arguments);
  if (arguments.json) return print_json(json_of(all));
  int kept = 0, runs = 0, behind = 0;
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    const PlannedTask& task = all.tasks[i];
    if (task.state == State::skipped) continue;
    (task.state == State::kept ? kept : task.state == State::runs ? runs : behind) += 1;
    const std::string why = task.why.text.empty() ? "" : " (" + task.why.text + ')';
    fmt::print("{}: {}{}\n", all.stage(i).name, name_of(task.state), why);
    if (task.state != State::kept) fmt::print("  {}\n", shell_text(task.argv));
  }
  fmt::print("{} kept, {} to run, {} behind them\n", kept, runs, behind);
  return contract::kDone;
}

int show_why(const Arguments& arguments) {
  const Look all = look(arguments);
  const int wanted = arguments.stage.empty() ? -1 : all.opened.instance.graph->index_of(arguments.stage);
  if (arguments.json)
    return print_json(wanted < 0 ? json_of(all) : json_of(all, static_cast<std::size_t>(wanted)));
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    const PlannedTask& task = all.tasks[i];
    const std::string& name = all.stage(i).name;
    if ((wanted >= 0 && static_cast<int>(i) != wanted) || task.state == State::skipped) continue;
    if (task.state == State::kept) {
      const StageRecord* last = all.last_of(i);
      const bool known = last != nullptr && !last->why.empty();
      fmt::print("{}: kept{}\n", name, known ? "; it last ran for: " + last->why : "");
      continue;
    }
    fmt::print("{}: {} ({})\n", name, name_of(task.state), task.why.text);
    for (const Difference& difference : task.why.differences) fmt::print("  {}\n", difference.text());
  }
  return contract::kDone;
}

int show_graph(const Arguments& arguments) {
  const OpenedPipeline opened = open_pipeline(arguments);
  const Graph& graph = *opened.instance.graph;
  if (arguments.json) return print_json(graph_json(graph));
  fmt::print("{}", graph_text(graph, arguments.format));
  return contract::kDone;
}

int show_status(const Arguments& arguments) {
  const Look all = look(arguments);
  Json json = json_of(all);
  std::vector<std::vector<std::string>> rows{{"stage", "state", "result", "why"}};
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    const PlannedTask& task = all.tasks[i];
    if (task.state == State::skipped) continue;
    json.at(rows.size() - 1)["state"] = state_in_status(all, i);
    rows.push_back({all.stage(i).name, state_in_status(all, i), task.hit ? shown_bytes(task.hit->bytes) : "-",
                    task.why.text});
  }
  if (arguments.json) return print_json(json);
  fmt::print("{}", aligned(rows, {2}));
  return contract::kDone;
}

}  // namespace sediment::runner
