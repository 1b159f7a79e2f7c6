#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/store/store.hpp"
#include "pipeline/runner/sweep/sweep_points.hpp"

namespace sediment::runner {

/// The results of an instance: where it stands on the axes of its sweep, and the receipt of each stage.
struct InstanceResults {
  SweepPoint point;
  std::vector<std::string> stages;  ///< in the order of the pipeline
  std::map<std::string, Receipt> receipts;
};

/// Reads the results below a folder that `--out` named, from the receipts alone: nothing is run or digested.
/// Logs are left out. Stages without a result are left out.
std::vector<InstanceResults> read_results(const std::filesystem::path& out, const Store& store);

/// A number that a receipt knows: "bytes", "seconds", "cpu_seconds", "memory" (bytes), a file of the result
/// (its bytes), or a metric (dotted: "ate.rmse"). Throws contract::UsageError naming the nearest known one.
double number_in(const Receipt& receipt, const std::string& name);

}  // namespace sediment::runner
