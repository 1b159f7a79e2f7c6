#include <fmt/format.h>

#include <algorithm>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/bring_up_to_date.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/opened_config.hpp"
#include "pipeline/runner/execution/text_table.hpp"
#include "pipeline/runner/store/key.hpp"
#include "pipeline/runner/sweep/result_table.hpp"
#include "pipeline/runner/sweep/sweep_file.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;
using contract::UsageError;

/// Longer tables are not printed behind a sweep.
constexpr std::size_t kMostRows = 60;

std::vector<InstanceResults> results_in(const fs::path& folder, const Arguments& arguments) {
  Arguments call = arguments;
  call.config.clear();
  call.out = folder;
  read_points(folder);  // says best what is wrong with a folder without results
  auto results = read_results(fs::absolute(folder).lexically_normal(), Store(store_of(call)));
  if (std::all_of(results.begin(), results.end(), [](const auto& one) { return one.receipts.empty(); }))
    throw UsageError(folder.string() + " has no results");
  return results;
}

std::string change(double before, double after, const std::string& shown_before,
                   const std::string& shown_after) {
  if (before == after) return shown_after;
  const std::string percent = before > 0 ? fmt::format(" ({:+.1f} %)", 100 * (after - before) / before) : "";
  return shown_before + " -> " + shown_after + percent;
}

void print_comparison(const std::string& label, const Receipt& a, const Receipt& b) {
  const bool same = a.object == b.object;
  const auto size = [](const Receipt& one) { return static_cast<double>(one.bytes); };
  fmt::print(
      "{}: {}, {}, {}\n", label, same ? "same bytes" : "other bytes",
      change(size(a), size(b), shown_bytes(a.bytes), shown_bytes(b.bytes)),
      change(a.wall_s, b.wall_s, fmt::format("{:.1f} s", a.wall_s), fmt::format("{:.1f} s", b.wall_s)));
  for (const Difference& one : differences(a.parts, b.parts)) fmt::print("  {}\n", one.text());
  const Json before = a.metrics.flatten(), after = b.metrics.flatten();
  for (const auto& [name, value] : before.items())
    if (after.contains(name) && after[name] != value)
      fmt::print("  metrics{}: {} -> {}\n", name, value.dump(), after[name].dump());
}

}  // namespace

int sweep(const Arguments& arguments) {
  const fs::path file = pipeline_file_of(arguments.config);
  if (fs::exists(file) && !is_sweep(file))
    throw UsageError(file.string() + " is a pipeline, no sweep: it names no \"pipeline\" to vary");
  const auto [code, is_complete] = bring_up_to_date(arguments);
  Arguments call = arguments;
  if (call.out.empty()) call.out = fs::path("out") / file.stem();
  const fs::path out = call.out;
  if (code != contract::kDone || !is_complete) return code;
  if (const std::size_t rows = read_points(out).size(); rows > kMostRows)
    fmt::print("\n`sediment table {}` shows all {} rows\n", out.string(), rows);
  else
    fmt::print("\nbytes of every result\n{}",
               format_table(make_table(results_in(out, call), {}), "markdown"));
  return code;
}

int show_table(const Arguments& arguments) {
  const TableRequest request{arguments.values, arguments.rows, arguments.columns, arguments.aggregate};
  fmt::print("{}",
             format_table(make_table(results_in(arguments.config, arguments), request), arguments.format));
  return contract::kDone;
}

int compare(const Arguments& arguments) {
  const auto a = results_in(arguments.config, arguments), b = results_in(arguments.other, arguments);
  std::size_t same = 0, different = 0, alone = 0;
  for (const InstanceResults& one : a) {
    const auto other =
        std::find_if(b.begin(), b.end(), [&](const auto& it) { return it.point.name == one.point.name; });
    for (const std::string& stage : one.stages) {
      const std::string label = one.point.name.empty() ? stage : one.point.name + '/' + stage;
      if (other == b.end() || !other->receipts.contains(stage)) {
        fmt::print("{}: only in {}\n", label, arguments.config.string());
        ++alone;
        continue;
      }
      const Receipt &before = one.receipts.at(stage), &after = other->receipts.at(stage);
      (before.object == after.object ? same : different) += 1;
      if (before.key != after.key || before.object != after.object) print_comparison(label, before, after);
    }
  }
  fmt::print("{} results the same, {} different, {} only in the first\n", same, different, alone);
  return contract::kDone;
}

}  // namespace sediment::runner
