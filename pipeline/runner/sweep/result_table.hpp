#pragma once

#include <string>
#include <vector>

#include "pipeline/runner/sweep/table_value.hpp"

namespace sediment::runner {

/// What a table shows.
struct TableRequest {
  std::vector<std::string> values;  ///< empty: the bytes of every stage
  std::vector<std::string> rows;    ///< axes, in order; empty: all that are no columns
  std::string columns;              ///< an axis of which every value gets columns of its own
  std::string aggregate;            ///< mean, sum, min or max of what falls into one cell
};

struct Cell {
  std::string text;                ///< for people
  std::optional<double> number{};  ///< of a value
};

/// The first row has the headings.
using ResultTable = std::vector<std::vector<Cell>>;

/// Throws contract::UsageError, also if several different numbers fall into one cell and no aggregate is
/// asked for.
ResultTable make_table(const std::vector<InstanceResults>& results, const TableRequest& request);

/// As "markdown", "csv", "json" or "latex". Markdown and LaTeX show numbers for people, CSV and JSON all
/// their digits.
std::string format_table(const ResultTable& table, const std::string& format);

}  // namespace sediment::runner
