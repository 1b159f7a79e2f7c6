#include "pipeline/runner/execution/closing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string summary(const std::vector<Task>& tasks, double seconds) {
  std::string text;
  for (const Outcome outcome : {Outcome::kept, Outcome::ran, Outcome::failed, Outcome::blocked,
                                Outcome::interrupted, Outcome::open}) {
    const auto count =
        std::count_if(tasks.begin(), tasks.end(), [&](const Task& task) { return task.outcome == outcome; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(outcome));
  }
  return fmt::format("{} in {:.2f} s\n", text, seconds);
}

std::string shown_seconds(double seconds) {
  return seconds > 0 ? fmt::format("{:.1f}", seconds) : "-";
}
std::string shown_or_dash(std::uint64_t bytes) {
  return bytes > 0 ? shown_bytes(bytes) : "-";
}

std::string row_per_task(const std::vector<Task>& tasks) {
  Rows rows{{"stage", "state", "seconds", "peak memory", "result", "why"}};
  for (const Task& task : tasks)
    rows.push_back({task.label, name_of(task.outcome), shown_seconds(task.wall_s),
                    shown_or_dash(task.peak_bytes), task.object.empty() ? "-" : shown_bytes(task.bytes),
                    task.why});
  return aligned(rows, {2, 3, 4});
}

/// All tasks of one stage.
struct StageSum {
  std::size_t kept = 0, ran = 0, failed = 0, others = 0;
  double seconds = 0;
  std::uint64_t peak_bytes = 0, bytes = 0;
  std::set<std::string> objects;
};

void add(StageSum& sum, const Task& task) {
  (task.outcome == Outcome::kept     ? sum.kept
   : task.outcome == Outcome::ran    ? sum.ran
   : task.outcome == Outcome::failed ? sum.failed
                                     : sum.others) += 1;
  sum.seconds += task.wall_s;
  sum.peak_bytes = std::max(sum.peak_bytes, task.peak_bytes);
  if (!task.object.empty() && sum.objects.insert(task.object).second) sum.bytes += task.bytes;
}

std::string row_per_stage(const std::vector<Task>& tasks) {
  std::vector<std::string> order;
  std::map<std::string, StageSum> sums;
  for (const Task& task : tasks) {
    const std::string stage = task.label.substr(task.label.rfind('/') + 1);
    const auto [sum, fresh] = sums.try_emplace(stage);
    if (fresh) order.push_back(stage);
    add(sum->second, task);
  }
  Rows rows{{"stage", "kept", "ran", "failed", "not run", "seconds", "peak memory", "distinct results"}};
  for (const std::string& stage : order) {
    const StageSum& sum = sums[stage];
    rows.push_back({stage, std::to_string(sum.kept), std::to_string(sum.ran), std::to_string(sum.failed),
                    std::to_string(sum.others), shown_seconds(sum.seconds), shown_or_dash(sum.peak_bytes),
                    fmt::format("{} ({})", sum.objects.size(), shown_bytes(sum.bytes))});
  }
  return aligned(rows, {1, 2, 3, 4, 5, 6, 7});
}

}  // namespace

std::string closing_table(const std::vector<Task>& tasks, double seconds) {
  const bool one_instance =
      std::all_of(tasks.begin(), tasks.end(), [](const Task& t) { return t.instance_idx == 0; });
  return (one_instance ? row_per_task(tasks) : row_per_stage(tasks)) + summary(tasks, seconds);
}

}  // namespace sediment::runner
