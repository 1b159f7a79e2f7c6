#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

/// Rows of texts as aligned columns; the first row is the heading. Columns named in `right` are flush right.
std::string aligned(const std::vector<std::vector<std::string>>& rows, const std::vector<std::size_t>& right);

/// "12.3 MB" (powers of ten).
std::string shown_bytes(std::uint64_t bytes);

/// What a run did: a row per stage, or with many instances a row per stage of all of them; then one line in
/// all.
std::string closing_table(const std::vector<Task>& tasks, double seconds);

}  // namespace sediment::runner
