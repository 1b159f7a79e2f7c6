#include "pipeline/runner/sweep/table_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/violations.hpp"

namespace sediment::runner {
namespace {

using contract::UsageError;

/// How much of the plain number makes one of the unit.
const std::map<std::string, double>& units() {
  static const std::map<std::string, double> all{
      {"", 1},       {"B", 1},         {"kB", 1e3},         {"MB", 1e6}, {"GB", 1e9},
      {"KiB", 1024}, {"MiB", 1048576}, {"GiB", 1073741824}, {"%", 0.01}, {"s", 1},
      {"ms", 1e-3},  {"min", 60},      {"h", 3600}};
  return all;
}

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

TableValue::Term term_from(const std::string& text, const std::vector<std::string>& stages) {
  const std::string term = trimmed(text);
  const std::size_t dot = term.find('.');
  const std::string stage = term.substr(0, dot);
  if (dot != std::string::npos && std::find(stages.begin(), stages.end(), stage) != stages.end())
    return {stage, term.substr(dot + 1)};
  return {"", term};
}

std::optional<double> evaluate_term(const TableValue::Term& term, const InstanceResults& results,
                                    const std::string& stage) {
  const auto receipt = results.receipts.find(term.stage.empty() ? stage : term.stage);
  if (receipt == results.receipts.end()) return std::nullopt;
  return number_in(receipt->second, term.name);
}

}  // namespace

TableValue table_value_from(const std::string& text, const std::vector<std::string>& stages) {
  TableValue value;
  value.heading = trimmed(text);
  std::string expression = value.heading;
  if (expression.ends_with(']') && expression.find('[') != std::string::npos) {
    const std::size_t begin = expression.rfind('[');
    value.unit = trimmed(expression.substr(begin + 1, expression.size() - begin - 2));
    expression = trimmed(expression.substr(0, begin));
  }
  if (!units().contains(value.unit)) throw UsageError(text + ": unknown unit \"" + value.unit + '"');
  // A file in a folder has a '/' in its name; a division has a stage behind it.
  for (std::size_t slash = expression.find('/'); slash != std::string::npos;
       slash = expression.find('/', slash + 1)) {
    const TableValue::Term divisor = term_from(expression.substr(slash + 1), stages);
    if (divisor.stage.empty()) continue;
    value.divisor = divisor;
    expression = expression.substr(0, slash);
    break;
  }
  value.term = term_from(expression, stages);
  if (value.term.name.empty())
    throw UsageError('"' + text + "\" is no value: expected stage.name, like voxel.bytes");
  return value;
}

std::optional<double> evaluate(const TableValue& value, const InstanceResults& results,
                               const std::string& stage) {
  auto number = evaluate_term(value.term, results, stage);
  if (number && value.divisor) {
    const auto divisor = evaluate_term(*value.divisor, results, stage);
    if (!divisor || *divisor == 0) return std::nullopt;
    number = *number / *divisor;
  }
  if (number) number = *number / units().at(value.unit);
  return number;
}

std::string shown_number(double number, const std::string& unit) {
  if (unit.empty() || unit == "B")
    return number == std::floor(number) && std::abs(number) < 1e15 ? fmt::format("{:.0f}", number)
                                                                   : fmt::format("{:.6g}", number);
  return fmt::format("{:.1f}", number);
}

}  // namespace sediment::runner
