#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sediment::runner {

/// Rows of texts as aligned columns; the first row is the heading. Columns in `right` are flush right.
std::string aligned(const std::vector<std::vector<std::string>>& rows, const std::vector<std::size_t>& right);

/// "12.3 MB" (powers of ten).
std::string shown_bytes(std::uint64_t bytes);

}  // namespace sediment::runner
