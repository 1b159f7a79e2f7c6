#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sediment::runner {

/// Amounts by name: "cpus", "memory" (bytes) and names of the user's own ("gpus", "licences").
using Amounts = std::map<std::string, std::uint64_t>;

/// What a stage asks for.
struct Resources {
  Amounts amounts;           ///< a stage that says nothing takes one of the cpus
  std::uint64_t time_s = 0;  ///< limit for a batch system, 0 = none
  int retries = 0;           ///< further attempts after a failure, each with twice the memory
};

/// Reads "4" or, for memory, "4 GB" (powers of ten) or "4GiB". Throws contract::UsageError.
std::uint64_t amount_from(const std::string& name, const std::string& text);

/// Reads "90", "90s", "15m", "2h" or "1d". Throws contract::UsageError.
std::uint64_t seconds_from(const std::string& text);

/// What this machine has (cpus and memory), overlaid by "name=amount" texts. Throws contract::UsageError.
Amounts capacity_of_machine(const std::vector<std::string>& overlays);

/// What is missing for a stage to run at all: "wants 8 cpus, this run has 2 (--resource cpus=8)"; empty if
/// nothing.
std::string shortage(const Amounts& wanted, const Amounts& capacity);

/// What is free of a capacity while stages run.
class FreeResources {
 public:
  explicit FreeResources(Amounts capacity) : free_(std::move(capacity)) {}
  bool suffice(const Amounts& wanted) const;
  void take(const Amounts& wanted);
  void give_back(const Amounts& taken);

 private:
  Amounts free_;
};

}  // namespace sediment::runner
