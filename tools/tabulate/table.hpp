#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sediment::tabulate {

/// A cell: what people read, and the number behind it.
struct Cell {
  std::string text;
  std::optional<double> number{};
};

/// A table that is written in three ways. Every row has as many cells as there are headings.
struct Table {
  std::vector<std::string> headings;
  std::vector<std::vector<Cell>> rows;
};

std::string to_markdown(const Table& table);
/// Numbers with all their digits.
std::string to_csv(const Table& table);
/// A tabular of booktabs.
std::string to_latex(const Table& table);

/// A number with so many decimals; "-" if there is none. `factor` brings it to the unit that is shown.
Cell shown(std::optional<double> number, int decimals, double factor = 1, const std::string& unit = "");

/// The middle of the values, between two the mean of both; none if there are none.
std::optional<double> median(std::vector<double> values);

/// printf.
std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace sediment::tabulate
