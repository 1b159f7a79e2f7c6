#include "pipeline/artifacts/label_csv.hpp"

#include <sstream>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/text_table.hpp"

namespace sediment {
namespace {

/// A name is the only column that may hold blanks; a comma or a quote in it is quoted as RFC 4180 says.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::vector<std::string> split_csv(std::string_view line) {
  std::vector<std::string> columns(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (inside && i + 1 < line.size() && line[i + 1] == '"')
        columns.back() += line[++i];
      else
        inside = !inside;
    } else if (line[i] == ',' && !inside) {
      columns.emplace_back();
    } else if (line[i] != '\r') {
      columns.back() += line[i];
    }
  }
  return columns;
}

Label label_from(const std::string& line) {
  const auto columns = split_csv(line);
  if (columns.size() != 5)
    throw std::runtime_error("expected 5 columns id,name,r,g,b, found " + std::to_string(columns.size()));
  Label label;
  label.id = static_cast<std::uint32_t>(expect_whole(columns[0], "id", UINT32_MAX));
  label.name = columns[1];
  for (int i = 0; i < 3; ++i)
    label.rgb[i] = static_cast<std::uint8_t>(expect_whole(columns[2 + i], "a colour", 255));
  return label;
}

}  // namespace

void write_label_csv(const std::filesystem::path& file, const LabelTable& labels,
                     const std::set<std::uint32_t>& present) {
  std::string text = "id,name,r,g,b\n";
  for (const Label& label : labels.labels()) {
    if (!present.contains(label.id)) continue;
    text += std::to_string(label.id) + "," + quoted(label.name);
    for (const std::uint8_t value : label.rgb) text += "," + std::to_string(value);
    text += "\n";
  }
  write_bytes(file, {text});
}

LabelTable read_label_csv(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  std::istringstream stream(read_bytes(file));
  std::vector<Label> labels;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.empty() || line == "\r" || line.starts_with('#') || line.starts_with("id,")) continue;
    try {
      labels.push_back(label_from(line));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  try {
    return LabelTable(std::move(labels));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace sediment
