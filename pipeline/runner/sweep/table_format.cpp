#include <fmt/format.h>

#include <algorithm>

#include "pipeline/runner/sweep/result_table.hpp"

namespace sediment::runner {
namespace {

using contract::Json;

std::string markdown(const ResultTable& table) {
  std::vector<std::size_t> widths(table[0].size(), 3);
  for (const auto& row : table)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].text.size());
  std::string text;
  for (std::size_t r = 0; r < table.size(); ++r) {
    for (std::size_t i = 0; i < table[r].size(); ++i)
      text += fmt::format(fmt::runtime(table[r][i].number ? "| {:>{}} " : "| {:<{}} "), table[r][i].text,
                          widths[i]);
    text += "|\n";
    for (std::size_t i = 0; r == 0 && i < widths.size(); ++i) {
      const bool numbers = table.size() > 1 && table[1][i].number.has_value();
      text += "|" + std::string(widths[i] + 1, '-') + (numbers ? ":" : "-");
    }
    if (r == 0) text += "|\n";
  }
  return text;
}

std::string csv(const ResultTable& table) {
  const auto quoted = [](const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string all = "\"";
    for (const char c : text) all += c == '"' ? "\"\"" : std::string(1, c);
    return all + '"';
  };
  std::string text;
  for (const auto& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += (i == 0 ? "" : ",") + (row[i].number ? fmt::format("{}", *row[i].number) : quoted(row[i].text));
    text += '\n';
  }
  return text;
}

std::string json(const ResultTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t r = 1; r < table.size(); ++r) {
    nlohmann::ordered_json row = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < table[r].size(); ++i) {
      auto& cell = row[table[0][i].text];
      if (table[r][i].number)
        cell = *table[r][i].number;
      else if (table[r][i].text != "-")
        cell = table[r][i].text;
    }
    rows.push_back(std::move(row));
  }
  return rows.dump(1) + '\n';
}

std::string latex(const ResultTable& table) {
  const auto escaped = [](const std::string& text) {
    std::string all;
    for (const char c : text) {
      if (std::string("&%$#_{}").find(c) != std::string::npos) all += '\\';
      all += c;
    }
    return all;
  };
  std::string columns;
  for (std::size_t i = 0; i < table[0].size(); ++i)
    columns += table.size() > 1 && table[1][i].number ? 'r' : 'l';
  std::string text = "\\begin{tabular}{" + columns + "}\n\\hline\n";
  for (std::size_t r = 0; r < table.size(); ++r) {
    for (std::size_t i = 0; i < table[r].size(); ++i)
      text += (i == 0 ? "" : " & ") + escaped(table[r][i].text);
    text += r == 0 ? " \\\\\n\\hline\n" : " \\\\\n";
  }
  return text + "\\hline\n\\end{tabular}\n";
}

}  // namespace

std::string format_table(const ResultTable& table, const std::string& format) {
  if (format == "csv") return csv(table);
  if (format == "json") return json(table);
  return format == "latex" ? latex(table) : markdown(table);
}

}  // namespace sediment::runner
