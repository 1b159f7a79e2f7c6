#include "pipeline/runner/sweep/results.hpp"

#include <algorithm>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/violations.hpp"
#include "pipeline/runner/execution/workspace.hpp"

namespace sediment::runner {
namespace {

using contract::Json;

/// All numbers below a JSON value, by their dotted names.
void collect_numbers(const Json& json, const std::string& name, std::map<std::string, double>& numbers) {
  if (json.is_number()) numbers[name] = json.get<double>();
  if (json.is_boolean()) numbers[name] = json.get<bool>() ? 1 : 0;
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items())
    collect_numbers(value, name.empty() ? key : name + '.' + key, numbers);
}

std::map<std::string, double> numbers_in(const Receipt& receipt) {
  std::map<std::string, double> numbers;
  collect_numbers(receipt.metrics, "", numbers);
  for (const auto& [path, bytes] : receipt.files) numbers[path] = static_cast<double>(bytes);
  numbers["bytes"] = static_cast<double>(receipt.bytes);
  numbers["seconds"] = receipt.wall_s;
  numbers["cpu_seconds"] = receipt.cpu_s;
  numbers["memory"] = static_cast<double>(receipt.peak_bytes);
  return numbers;
}

}  // namespace

std::vector<InstanceResults> read_results(const std::filesystem::path& out, const Store& store) {
  std::vector<InstanceResults> all;
  for (SweepPoint& point : read_points(out)) {
    InstanceResults results;
    const RunRecord record = Workspace(point.name.empty() ? out : out / point.name).read_record();
    for (const std::string& stage : record.order) {
      const std::string& key = record.stages.at(stage).key;  // empty: the stage was never reached
      auto receipt = key.empty() ? std::nullopt : store.receipt(key);
      if (!receipt) continue;
      receipt->log.clear();
      results.stages.push_back(stage);
      results.receipts[stage] = std::move(*receipt);
    }
    results.point = std::move(point);
    all.push_back(std::move(results));
  }
  return all;
}

double number_in(const Receipt& receipt, const std::string& name) {
  const auto numbers = numbers_in(receipt);
  if (const auto found = numbers.find(name); found != numbers.end()) return found->second;
  std::vector<std::string> known;
  std::string list;
  for (const auto& [one, number] : numbers) {
    known.push_back(one);
    if (known.size() <= 40) list += (list.empty() ? "" : ", ") + one;
  }
  throw contract::UsageError(receipt.parts.at("stage").get<std::string>() + " has no number \"" + name +
                             "\"" + did_you_mean(name, known) + "; it has: " + list);
}

}  // namespace sediment::runner
