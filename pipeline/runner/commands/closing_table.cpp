#include "pipeline/runner/commands/closing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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

std::string aligned(const std::vector<std::vector<std::string>>& rows,
                    const std::vector<std::size_t>& right) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths.resize(std::max(widths.size(), i + 1));
      widths[i] = std::max(widths[i], row[i].size());
    }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool flush_right = std::find(right.begin(), right.end(), i) != right.end();
      line += fmt::format(fmt::runtime(flush_right ? "{:>{}}  " : "{:<{}}  "), row[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string shown_bytes(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  double value = static_cast<double>(bytes);
  const char* unit = "";
  for (const char* next : {"kB", "MB", "GB", "TB"}) {
    if (value < 1000) break;
    value /= 1000;
    unit = next;
  }
  return fmt::format("{:.1f} {}", value, unit);
}

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
