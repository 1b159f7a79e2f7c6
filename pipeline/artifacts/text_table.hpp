#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sediment {

/// A line of a text file of columns (TUM lists and trajectories, CSV).
struct TextRow {
  int line = 0;  ///< from 1
  std::span<const std::string_view> columns;
};

/// Calls `row` for every line that is neither empty nor a comment (#). Columns are separated by blanks, tabs
/// or commas; LF or CRLF ends a line. What `row` throws gets "file:line: " in front. Throws
/// std::runtime_error that names the file if it cannot be read.
void read_rows(const std::filesystem::path& file, const std::function<void(const TextRow&)>& row);

/// A finite number written in full, none otherwise.
std::optional<double> parse_number(std::string_view text);

/// As above; throws std::runtime_error "expected a number for NAME, found TEXT".
double expect_number(std::string_view text, std::string_view name);

/// A whole number within the bounds; throws std::runtime_error as above.
std::uint64_t expect_whole(std::string_view text, std::string_view name, std::uint64_t max);

}  // namespace sediment
