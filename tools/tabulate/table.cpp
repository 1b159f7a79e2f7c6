#include "tools/tabulate/table.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace sediment::tabulate {
namespace {

/// Whether a column is one of numbers: then it stands to the right.
bool is_numeric(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return row[column].number.has_value(); });
}

std::string escaped_latex(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (std::string("&%$#_{}").find(c) != std::string::npos) all += '\\';
    all += c;
  }
  return all;
}

}  // namespace

std::string to_markdown(const Table& table) {
  std::string text = "|", rule = "|";
  for (std::size_t i = 0; i < table.headings.size(); ++i) {
    text += ' ' + table.headings[i] + " |";
    rule += is_numeric(table, i) ? "---:|" : "---|";
  }
  text += '\n' + rule + '\n';
  for (const auto& row : table.rows) {
    text += '|';
    for (const Cell& cell : row) text += ' ' + cell.text + " |";
    text += '\n';
  }
  return text;
}

std::string to_csv(const Table& table) {
  const auto quoted = [](const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string all = "\"";
    for (const char c : text) all += c == '"' ? "\"\"" : std::string(1, c);
    return all + '"';
  };
  std::string text;
  for (std::size_t i = 0; i < table.headings.size(); ++i) text += (i ? "," : "") + quoted(table.headings[i]);
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += i ? "," : "";
      if (row[i].number)
        text += formatted("%.10g", *row[i].number);
      else if (row[i].text != "-")
        text += quoted(row[i].text);
    }
    text += '\n';
  }
  return text;
}

std::string to_latex(const Table& table) {
  std::string columns, text;
  for (std::size_t i = 0; i < table.headings.size(); ++i) columns += is_numeric(table, i) ? 'r' : 'l';
  text = "\\begin{tabular}{" + columns + "}\n\\toprule\n";
  for (std::size_t i = 0; i < table.headings.size(); ++i)
    text += (i ? " & " : "") + escaped_latex(table.headings[i]);
  text += " \\\\\n\\midrule\n";
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i ? " & " : "") + escaped_latex(row[i].text);
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

Cell shown(std::optional<double> number, int decimals, double factor, const std::string& unit) {
  if (!number) return {"-", std::nullopt};
  return {formatted("%.*f", decimals, *number * factor) + unit, *number * factor};
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

std::string formatted(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace sediment::tabulate
