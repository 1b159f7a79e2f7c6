#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/runner/sweep/results.hpp"

namespace sediment::runner {

/// A value of a table as it is written: "voxel.bytes [MB]", "voxel.cloud.pcd/fuse.cloud.pcd [%]", or without
/// a stage
/// ("seconds"), for tables with a row per stage.
struct TableValue {
  struct Term {
    std::string stage;  ///< empty: that of the row
    std::string name;
  };
  std::string heading;  ///< as it is written
  Term term;
  std::optional<Term> divisor;
  std::string unit;
  bool needs_stage() const { return term.stage.empty(); }
};

/// `stages` are the known ones. Throws contract::UsageError.
TableValue table_value_from(const std::string& text, const std::vector<std::string>& stages);

/// In the value's unit; nothing if a stage has no result.
std::optional<double> evaluate(const TableValue& value, const InstanceResults& results,
                               const std::string& stage);

/// For people: megabytes, percents and seconds with one decimal, whole numbers whole, others with six digits.
std::string shown_number(double number, const std::string& unit);

}  // namespace sediment::runner
