#include "pipeline/artifacts/text_table.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "pipeline/artifacts/file_bytes.hpp"

namespace sediment {
namespace {

bool separates(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}

void split(std::string_view line, std::vector<std::string_view>& columns) {
  columns.clear();
  for (std::size_t at = 0; at < line.size();) {
    if (separates(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !separates(line[end])) ++end;
    columns.push_back(line.substr(at, end - at));
    at = end;
  }
}

}  // namespace

void read_rows(const std::filesystem::path& file, const std::function<void(const TextRow&)>& row) {
  const std::string text = read_bytes(file);
  std::vector<std::string_view> columns;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find('\n', at);
    if (end == std::string::npos) end = text.size();
    split(std::string_view(text).substr(at, end - at), columns);
    at = end + 1;
    ++number;
    if (columns.empty() || columns[0].starts_with('#')) continue;
    try {
      row({number, columns});
    } catch (const std::exception& error) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
}

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double expect_number(std::string_view text, std::string_view name) {
  if (const auto value = parse_number(text)) return *value;
  throw std::runtime_error("expected a number for " + std::string(name) + ", found \"" + std::string(text) +
                           "\"");
}

std::uint64_t expect_whole(std::string_view text, std::string_view name, std::uint64_t max) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > max)
    throw std::runtime_error("expected a whole number of 0 .. " + std::to_string(max) + " for " +
                             std::string(name) + ", found \"" + std::string(text) + "\"");
  return value;
}

}  // namespace sediment
