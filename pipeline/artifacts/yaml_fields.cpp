#include "pipeline/artifacts/yaml_fields.hpp"

#include <set>

namespace sediment {
namespace {

std::string at_line(const std::string& file, const YAML::Mark& mark, const std::string& what) {
  const std::string place = mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
  return place + ": " + what;
}

}  // namespace

YamlFields::YamlFields(std::string file, YAML::Node node, std::initializer_list<std::string_view> known)
    : file_(std::move(file)), node_(std::move(node)) {
  std::string list;
  for (const std::string_view key : known) list += (list.empty() ? "" : ", ") + std::string(key);
  if (!node_.IsMap()) fail(node_, "expected a mapping with the keys " + list);
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const auto key = entry.first.as<std::string>("");
    if (std::find(known.begin(), known.end(), key) == known.end())
      fail(entry.first, "unknown key \"" + key + "\" (known: " + list + ")");
    if (!seen.insert(key).second) fail(entry.first, "key \"" + key + "\" is given twice");
  }
}

void YamlFields::fail(const YAML::Node& at, const std::string& what) const {
  throw std::runtime_error(at_line(file_, at.Mark(), what));
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(at_line(file, error.mark, error.msg));
  }
}

}  // namespace sediment
