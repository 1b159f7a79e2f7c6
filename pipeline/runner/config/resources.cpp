#include "pipeline/runner/config/resources.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "pipeline/contract/errors.hpp"

namespace sediment::runner {
namespace {

using contract::UsageError;

/// "1.5 GB" as 1.5 and "GB".
std::pair<double, std::string> number_and_unit(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  unit.erase(0, unit.find_first_not_of(' '));
  const bool fits = error == std::errc{} && number >= 0 && number < 1e18;
  return {fits ? number : -1, unit};
}

/// The number in units of one; `units` maps a unit to its size.
std::uint64_t scaled(const std::string& what, const std::string& text, const std::string& expected,
                     const std::map<std::string, double>& units) {
  const auto [number, unit] = number_and_unit(text);
  const auto scale = units.find(unit);
  if (number < 0 || scale == units.end())
    throw UsageError(what + ": expected " + expected + ", found \"" + text + '"');
  return static_cast<std::uint64_t>(std::llround(number * scale->second));
}

std::string shown(const std::string& name, std::uint64_t amount) {
  return name == "memory" ? std::to_string(amount / 1'000'000) + " MB of memory"
                          : std::to_string(amount) + ' ' + name;
}

}  // namespace

std::uint64_t amount_from(const std::string& name, const std::string& text) {
  if (name != "memory") {
    const std::uint64_t amount = scaled(name, text, "a whole number", {{"", 1}});
    if (number_and_unit(text).first != static_cast<double>(amount))
      throw UsageError(name + ": expected a whole number, found \"" + text + '"');
    return amount;
  }
  return scaled(name, text, "an amount like 4 GB",
                {{"", 1},
                 {"B", 1},
                 {"kB", 1e3},
                 {"MB", 1e6},
                 {"GB", 1e9},
                 {"TB", 1e12},
                 {"KiB", 1024},
                 {"MiB", 1048576},
                 {"GiB", 1073741824}});
}

std::uint64_t seconds_from(const std::string& text) {
  return scaled("time", text, "a time like 90s, 15m, 2h or 1d",
                {{"", 1}, {"s", 1}, {"m", 60}, {"h", 3600}, {"d", 86400}});
}

Amounts capacity_of_machine(const std::vector<std::string>& overlays) {
  Amounts capacity{{"cpus", static_cast<std::uint64_t>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)))},
                   {"memory", static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                  static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE))}};
  for (const std::string& overlay : overlays) {
    const std::size_t equals = overlay.find('=');
    if (equals == std::string::npos) throw UsageError("--resource " + overlay + ": expected name=amount");
    const std::string name = overlay.substr(0, equals);
    capacity[name] = amount_from(name, overlay.substr(equals + 1));
  }
  return capacity;
}

std::string shortage(const Amounts& wanted, const Amounts& capacity) {
  for (const auto& [name, amount] : wanted) {
    const auto has = capacity.find(name);
    const std::uint64_t there = has == capacity.end() ? 0 : has->second;
    if (amount <= there) continue;
    return "wants " + shown(name, amount) + ", this run has " + shown(name, there) + " (--resource " + name +
           "=AMOUNT)";
  }
  return "";
}

bool FreeResources::suffice(const Amounts& wanted) const {
  return std::all_of(wanted.begin(), wanted.end(), [&](const auto& one) {
    const auto free = free_.find(one.first);
    return free != free_.end() && one.second <= free->second;
  });
}

void FreeResources::take(const Amounts& wanted) {
  for (const auto& [name, amount] : wanted) free_[name] -= amount;
}

void FreeResources::give_back(const Amounts& taken) {
  for (const auto& [name, amount] : taken) free_[name] += amount;
}

}  // namespace sediment::runner
