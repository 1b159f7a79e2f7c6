#include <fmt/format.h>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/commands.hpp"
#include "pipeline/runner/commands/opened_pipeline.hpp"
#include "pipeline/runner/config/graph_text.hpp"
#include "pipeline/runner/execution/plan.hpp"
#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner {
namespace {

using State = PlannedTask::State;

std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}#~`!") == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + '\'';
}

std::string call_of(const std::vector<std::string>& argv) {
  std::string text;
  for (const std::string& word : argv) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

const char* name_of_state(State state) {
  switch (state) {
    case State::kept:
      return "kept";
    case State::runs:
      return "runs";
    case State::behind:
      return "may run";
    case State::skipped:
      return "skipped";
  }
  return "";
}

struct Look {
  OpenedPipeline opened;
  std::vector<PlannedTask> tasks;
  const PlannedStage& stage(std::size_t i) const { return opened.instance.graph->stages[i]; }
};

Look look(const Arguments& arguments) {
  Look all{open_pipeline(arguments), {}};
  all.tasks = plan(all.opened.instance, *all.opened.store, arguments.threads);
  all.opened.store->memory().save();
  return all;
}

}  // namespace

int show_plan(const Arguments& arguments) {
  const Look all = look(arguments);
  int kept = 0, runs = 0, behind = 0;
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    const PlannedTask& task = all.tasks[i];
    if (task.state == State::skipped) continue;
    (task.state == State::kept ? kept : task.state == State::runs ? runs : behind) += 1;
    const std::string why = task.why.text.empty() ? "" : " (" + task.why.text + ')';
    fmt::print("{}: {}{}\n", all.stage(i).name, name_of_state(task.state), why);
    if (task.state != State::kept) fmt::print("  {}\n", call_of(task.argv));
  }
  fmt::print("{} kept, {} to run, {} behind them\n", kept, runs, behind);
  return contract::kDone;
}

int show_why(const Arguments& arguments) {
  const Look all = look(arguments);
  const int wanted = arguments.stage.empty() ? -1 : all.opened.instance.graph->index_of(arguments.stage);
  const auto last = Workspace(all.opened.instance.out).read_record();
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    const PlannedTask& task = all.tasks[i];
    const std::string& name = all.stage(i).name;
    if ((wanted >= 0 && static_cast<int>(i) != wanted) || task.state == State::skipped) continue;
    if (task.state == State::kept) {
      const auto record = last.find(name);
      const bool known = record != last.end() && !record->second.why.empty();
      fmt::print("{}: kept{}\n", name, known ? "; it last ran for: " + record->second.why : "");
      continue;
    }
    fmt::print("{}: {} ({})\n", name, name_of_state(task.state), task.why.text);
    for (const Difference& difference : task.why.differences) fmt::print("  {}\n", difference.text());
  }
  return contract::kDone;
}

int show_graph(const Arguments& arguments) {
  const OpenedPipeline opened = open_pipeline(arguments);
  fmt::print("{}", graph_text(*opened.instance.graph, arguments.format));
  return contract::kDone;
}

int show_status(const Arguments& arguments) {
  const Look all = look(arguments);
  const auto last = Workspace(all.opened.instance.out).read_record();
  std::vector<std::vector<std::string>> rows{{"stage", "state", "result", "why"}};
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    const PlannedTask& task = all.tasks[i];
    if (task.state == State::skipped) continue;
    const auto record = last.find(all.stage(i).name);
    std::string state = task.state == State::kept ? "up to date" : "to run";
    if (task.state == State::behind) state = "may run";
    if (task.state != State::kept && record != last.end() && record->second.state == "failed")
      state = "failed";
    if (task.key && !task.hit && all.opened.store->is_locked(task.key->id)) state = "running";
    rows.push_back({all.stage(i).name, state, task.hit ? shown_bytes(task.hit->bytes) : "-", task.why.text});
  }
  fmt::print("{}", aligned(rows, {2}));
  return contract::kDone;
}

}  // namespace sediment::runner
