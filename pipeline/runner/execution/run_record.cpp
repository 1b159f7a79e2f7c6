#include "pipeline/runner/execution/run_record.hpp"

#include <fmt/chrono.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>

#include "pipeline/contract/digest.hpp"
#include "pipeline/runner/execution/workspace.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* kRunLogFormat = "sediment-run-log 1";

void write(const fs::path& file, const OrderedJson& json) {
  std::ofstream stream(file, std::ios::binary);
  stream << json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno));
}

/// The words of the call of this program.
OrderedJson own_call() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  OrderedJson words = OrderedJson::array();
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

OrderedJson event_of(const Task& task) {
  return {
      {"name", task.label},
      {"cat", name_of(task.outcome)},
      {"ph", "X"},
      {"ts", task.started_s * 1e6},
      {"dur", task.wall_s * 1e6},
      {"pid", 1},
      {"tid", task.lane},
      {"args",
       {{"why", task.why}, {"cpu_s", task.cpu_s}, {"peak_bytes", task.peak_bytes}, {"bytes", task.bytes}}}};
}

OrderedJson json_of(const Task& task) {
  return {{"stage", task.label},
          {"state", name_of(task.outcome)},
          {"why", task.why},
          {"key", task.key},
          {"object", task.object},
          {"started_s", task.started_s},
          {"wall_s", task.wall_s},
          {"cpu_s", task.cpu_s},
          {"peak_bytes", task.peak_bytes},
          {"bytes", task.bytes},
          {"retries", task.retries},
          {"log", task.log}};
}

void update(StageRecord& record, const Task& task) {
  const bool same = record.key == task.key && !record.state.empty();
  record.state = name_of(task.outcome);
  record.log = task.log;
  if (task.outcome == Outcome::kept || task.outcome == Outcome::ran) {
    record.key = task.key;
    record.object = task.object;
    record.bytes = task.bytes;
  }
  if (task.outcome == Outcome::kept && same) return;
  record.why = task.why;
  if (task.outcome == Outcome::kept) return;
  record.wall_s = task.wall_s;
  record.peak_bytes = task.peak_bytes;
}

}  // namespace

void write_run(const fs::path& folder, const std::vector<Task>& tasks, double seconds) {
  OrderedJson log = {{"format", kRunLogFormat},
                     {"call", own_call()},
                     {"ended", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
                     {"host", host_name()},
                     {"seconds", seconds},
                     {"kept", 0},
                     {"stages", OrderedJson::array()}};
  OrderedJson trace = {{"displayTimeUnit", "ms"}, {"traceEvents", OrderedJson::array()}};
  std::size_t kept = 0;
  for (const Task& task : tasks) {
    if (task.outcome == Outcome::kept)
      ++kept;
    else
      log["stages"].push_back(json_of(task));
    if (task.lane >= 0) trace["traceEvents"].push_back(event_of(task));
  }
  log["kept"] = kept;
  fs::create_directories(folder);
  write(folder / "run.json", log);
  write(folder / "trace.json", trace);
}

void record(const std::vector<Instance>& instances, const std::vector<Task>& tasks, const std::string& run) {
  for (auto first = tasks.begin(); first != tasks.end();) {
    auto last = first;
    std::string keys;
    for (; last != tasks.end() && last->instance_idx == first->instance_idx; ++last)
      keys += last->key + name_of(last->outcome == Outcome::ran ? Outcome::kept : last->outcome) + '\n';
    const Instance& instance = instances[first->instance_idx];
    const Workspace workspace(instance.out);
    const std::string id = contract::digest_bytes(keys);
    if (workspace.recorded() != id) {
      RunRecord record = workspace.read_record();
      for (auto task = first; task != last; ++task)
        update(record.stages[instance.graph->stages[task->stage_idx].name], *task);
      record.order.clear();
      for (const PlannedStage& stage : instance.graph->stages)
        if (record.stages.contains(stage.name)) record.order.push_back(stage.name);
      record.id = id;
      if (!run.empty()) record.run = run;
      workspace.write_record(record);
    }
    first = last;
  }
}

}  // namespace sediment::runner
