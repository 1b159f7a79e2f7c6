#pragma once

#include <cstddef>
#include <optional>

namespace sediment::tools {

/// part / whole, between 0 and 1; nothing of nothing is no number.
inline std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace sediment::tools
