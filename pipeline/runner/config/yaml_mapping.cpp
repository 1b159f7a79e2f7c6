#include "pipeline/runner/config/yaml_mapping.hpp"

#include <fstream>
#include <iterator>
#include <set>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"

namespace sediment::runner {

YAML::Node load_yaml(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream || std::filesystem::is_directory(file))
    throw contract::UsageError("cannot read the configuration " + file.string());
  try {
    return YAML::Load(mark_variables(text));
  } catch (const YAML::ParserException& error) {
    throw contract::UsageError(file.string() + ':' + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
}

int line_of(const YAML::Node& node) {
  return node.Mark().line + 1;
}

Mapping& Mapping::key(const std::string& name, Reader reader) {
  readers_[name] = std::move(reader);
  return *this;
}

Mapping& Mapping::any(Reader reader) {
  any_ = std::move(reader);
  return *this;
}

void Mapping::read(const YAML::Node& node, int line) const {
  if (node.IsNull()) return;
  if (!node.IsMap()) return violations_.add(line, what_ + ": expected a mapping of names to values");
  std::set<std::string> seen;
  for (const auto& pair : node) {
    if (!pair.first.IsScalar()) {
      violations_.add(line_of(pair.first), what_ + ": a key must be a name");
      continue;
    }
    const std::string name = pair.first.Scalar();
    if (!seen.insert(name).second)
      violations_.add(line_of(pair.first), what_ + ": \"" + name + "\" is there twice");
    else if (const auto known = readers_.find(name); known != readers_.end())
      known->second(pair.first, pair.second);
    else if (any_)
      any_(pair.first, pair.second);
    else
      violations_.add(line_of(pair.first),
                      what_ + ": unknown key \"" + name + "\"" + did_you_mean(name, names()));
  }
}

std::vector<std::string> Mapping::names() const {
  std::vector<std::string> all;
  for (const auto& [name, reader] : readers_) all.push_back(name);
  return all;
}

Mapping::Reader text_into(std::string& text, const std::string& what, Violations& violations) {
  return [&text, &violations, what](const YAML::Node& key, const YAML::Node& value) {
    if (value.IsScalar())
      text = value.Scalar();
    else
      violations.add(line_of(key), what + ": expected a text for \"" + key.Scalar() + '"');
  };
}

}  // namespace sediment::runner
