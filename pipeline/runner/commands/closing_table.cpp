#include "pipeline/runner/commands/closing_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner {
namespace {

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

}  // namespace

std::string closing_table(const std::vector<Task>& tasks, double seconds) {
  std::vector<std::vector<std::string>> rows{{"stage", "state", "seconds", "peak memory", "result", "why"}};
  for (const Task& task : tasks) {
    const bool ran = task.wall_s > 0;
    const bool has_result = !task.object.empty();
    rows.push_back({task.label, name_of(task.outcome), ran ? fmt::format("{:.1f}", task.wall_s) : "-",
                    ran ? shown_bytes(task.peak_bytes) : "-", has_result ? shown_bytes(task.bytes) : "-",
                    task.why});
  }
  return aligned(rows, {2, 3, 4}) + summary(tasks, seconds);
}

}  // namespace sediment::runner
