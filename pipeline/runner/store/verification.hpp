#pragma once

#include <string>
#include <vector>

#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// What a check of a store by digest has found.
struct Verification {
  std::size_t receipts = 0, objects = 0;  ///< that were checked
  std::uint64_t bytes = 0;                ///< that were read
  std::vector<std::string> damages;       ///< what was put aside, and why
};

/// Checks every receipt and a random share (0 .. 1) of the results by digest. What is damaged goes to
/// quarantine/, so that the next run makes it again.
Verification verify(const Store& store, double share);

}  // namespace sediment::runner
