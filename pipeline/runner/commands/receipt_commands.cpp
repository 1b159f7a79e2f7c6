#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <iterator>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/look.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner {
namespace {

using contract::Json;
using contract::UsageError;

/// The last receipt of a stage in its folder of results.
Receipt last_receipt(const LookedAt& one, const Store& store) {
  const auto receipt = one.last ? store.receipt(one.last->key) : std::nullopt;
  if (!receipt) throw UsageError(one.label + " has no result yet");
  return *receipt;
}

void print_failure(const StageRecord& last) {
  std::ifstream stream(last.log, std::ios::binary);
  fmt::print("failed: {}\n{}", last.why, std::string(std::istreambuf_iterator<char>(stream), {}));
}

/// What a stage has said that runs at this moment, under this or another runner.
void print_so_far(const LookedAt& one, Store& store) {
  fmt::print("{}: running ({})\n", one.label, one.task.why.text);
  const auto attempt = store.attempts().find(one.task.key->id);
  if (!attempt) return;
  std::ifstream stream(*attempt / "log", std::ios::binary);
  fmt::print("{}", std::string(std::istreambuf_iterator<char>(stream), {}));
}

}  // namespace

int show_log(const Arguments& arguments) {
  const Look all = look(arguments);
  const LookedAt& one = *all.named(arguments.stage).front();
  if (one.task.key && !one.task.hit && all.opened.store->is_locked(one.task.key->id)) {
    print_so_far(one, *all.opened.store);
    return contract::kDone;
  }
  if (one.last && one.last->state == "failed") {
    print_failure(*one.last);
    return contract::kDone;
  }
  const Receipt receipt = last_receipt(one, *all.opened.store);
  fmt::print("{}\nmade {} on {} in {:.1f} s ({:.1f} s of cpu, {}), because: {}\n", shell_text(receipt.argv),
             receipt.started, receipt.host, receipt.wall_s, receipt.cpu_s, shown_bytes(receipt.peak_bytes),
             receipt.why);
  if (!receipt.accepted.is_null()) fmt::print("accepted: {}\n", receipt.accepted.dump());
  fmt::print("{}", receipt.log);
  return contract::kDone;
}

int accept_stage(const Arguments& arguments) {
  const Look all = look(arguments);
  const LookedAt& one = *all.named(arguments.stage).front();
  const PlannedTask& task = one.task;
  if (task.hit) throw UsageError(arguments.stage + " is up to date: there is nothing to accept");
  if (!task.key) throw UsageError(arguments.stage + " is " + task.why.text + ": accept or run that first");
  Store& store = *all.opened.store;
  Receipt receipt = last_receipt(one, store);
  const auto hit = store.find(receipt.key);
  if (!hit) throw UsageError("the last result of " + arguments.stage + " is lost or damaged");
  Json changed = Json::array();
  for (const Difference& difference : task.why.differences) changed.push_back(difference.text());
  receipt.accepted = {{"from", receipt.key},
                      {"changed", changed},
                      {"when", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
                      {"by", environment("USER").value_or("unknown")}};
  receipt.key = task.key->id;
  receipt.parts = Json::parse(task.key->text);
  const auto lock = store.try_lock(receipt.key);
  if (!lock) throw std::runtime_error(arguments.stage + " is being made by another runner");
  store.publish_receipt(receipt);
  store.memory().save();
  for (const Difference& difference : task.why.differences) fmt::print("  {}\n", difference.text());
  fmt::print("{}: its last result counts as right all the same\n", arguments.stage);
  return contract::kDone;
}

}  // namespace sediment::runner
