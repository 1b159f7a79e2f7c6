#include "pipeline/runner/sweep/result_table.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/violations.hpp"

namespace sediment::runner {
namespace {

using contract::UsageError;
using Names = std::vector<std::string>;

constexpr const char* kStage = "stage";

/// A result at its place on every axis.
struct Located {
  std::map<std::string, std::string> place;
  const InstanceResults* results;
  std::string stage;  ///< if the table has a row or column per stage
};

template <class T>
bool contains(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

Names stages_in(const std::vector<InstanceResults>& results) {
  Names stages;
  for (const InstanceResults& one : results)
    for (const std::string& stage : one.stages)
      if (!contains(stages, stage)) stages.push_back(stage);
  return stages;
}

Names axes_in(const std::vector<InstanceResults>& results, bool by_stage) {
  Names axes;
  for (const auto& [name, value] : results.front().point.values) axes.push_back(name);
  if (by_stage) axes.push_back(kStage);
  return axes;
}

std::vector<Located> located(const std::vector<InstanceResults>& results, bool by_stage) {
  std::vector<Located> all;
  for (const InstanceResults& one : results) {
    const std::map<std::string, std::string> place(one.point.values.begin(), one.point.values.end());
    if (!by_stage) all.push_back({place, &one, ""});
    for (const std::string& stage : by_stage ? one.stages : Names()) {
      all.push_back({place, &one, stage});
      all.back().place[kStage] = stage;
    }
  }
  return all;
}

double aggregated(const std::vector<double>& numbers, const std::string& how, const std::string& what) {
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  if (how == "mean") return sum / static_cast<double>(numbers.size());
  if (how == "sum") return sum;
  if (how == "max") return *most;
  if (how.empty() && *least != *most)
    throw UsageError(
        what +
        ": several different values fall into one cell: name more axes in --row or --columns, or "
        "--aggregate mean, sum, min or max");
  return *least;
}

Cell cell_of(const TableValue& value, const std::vector<const Located*>& group, const TableRequest& request) {
  std::vector<double> numbers;
  for (const Located* one : group)
    if (const auto number = evaluate(value, *one->results, one->stage)) numbers.push_back(*number);
  if (numbers.empty()) return {"-", std::nullopt};
  const double number = aggregated(numbers, request.aggregate, value.heading);
  return {shown_number(number, value.unit), number};
}

/// The distinct values of an axis in the order they first appear.
Names values_on(const std::string& axis, const std::vector<Located>& all) {
  Names values;
  for (const Located& one : all)
    if (!contains(values, one.place.at(axis))) values.push_back(one.place.at(axis));
  return values;
}

void check_axis(const std::string& axis, const Names& axes) {
  if (contains(axes, axis)) return;
  throw UsageError("unknown axis \"" + axis + "\"" + did_you_mean(axis, axes));
}

}  // namespace

ResultTable make_table(const std::vector<InstanceResults>& results, const TableRequest& request) {
  const Names stages = stages_in(results);
  std::vector<TableValue> values;
  Names texts = request.values;
  if (texts.empty())
    for (const std::string& stage : stages) texts.push_back(stage + ".bytes");
  for (const std::string& text : texts) values.push_back(table_value_from(text, stages));
  const bool by_stage =
      std::any_of(values.begin(), values.end(), [](const auto& one) { return one.needs_stage(); });

  const Names axes = axes_in(results, by_stage);
  Names rows = request.rows;
  for (const std::string& axis : axes)
    if (request.rows.empty() && axis != request.columns) rows.push_back(axis);
  for (const std::string& axis : rows) check_axis(axis, axes);
  if (!request.columns.empty()) check_axis(request.columns, axes);
  const std::vector<Located> all = located(results, by_stage);
  const Names columns = request.columns.empty() ? Names{""} : values_on(request.columns, all);

  std::vector<Names> order;
  std::map<Names, std::map<std::string, std::vector<const Located*>>> groups;
  for (const Located& one : all) {
    Names row;
    for (const std::string& axis : rows) row.push_back(one.place.at(axis));
    if (!groups.contains(row)) order.push_back(row);
    groups[row][request.columns.empty() ? "" : one.place.at(request.columns)].push_back(&one);
  }

  ResultTable table(1);
  for (const std::string& axis : rows) table[0].push_back({axis});
  for (const std::string& column : columns)
    for (const TableValue& value : values)
      table[0].push_back(
          {column.empty() ? value.heading : value.heading + ", " + request.columns + '=' + column});
  for (const Names& row : order) {
    std::vector<Cell> cells;
    for (const std::string& name : row) cells.push_back({name});
    for (const std::string& column : columns)
      for (const TableValue& value : values) cells.push_back(cell_of(value, groups[row][column], request));
    table.push_back(std::move(cells));
  }
  return table;
}

}  // namespace sediment::runner
