#pragma once

#include "tools/tabulate/run_facts.hpp"
#include "tools/tabulate/table.hpp"

namespace sediment::tabulate {

/// Two tables of a sweep. `each`: an instance a row, with trajectory error (TUM's ATE and RPE over 1 s),
/// coverage, map quality where the sequence has its truth, sizes, time, memory and the receipts the figures
/// came from. `summary`: for every setting (all axes but the sequence) the median over the sequences, with
/// the smallest and the largest. What an instance has no truth for is "-".
struct EvaluationTables {
  Table each, summary;
};

/// Throws std::runtime_error that names what cannot be read. An estimate that cannot be judged (no truth,
/// nothing in common) has "-" and its reason in the column `note`.
EvaluationTables evaluation_tables(const RunFacts& facts);

}  // namespace sediment::tabulate
