#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/config/violations.hpp"

namespace sediment::runner {

/// The document in a file, its variables marked (variables.hpp). Throws contract::UsageError with the line.
YAML::Node load_yaml(const std::filesystem::path& file);

/// Line of a node, from 1.
int line_of(const YAML::Node& node);

/// One mapping of the file: hands each known key to its reader; unknown keys, repeated keys (YAML would keep
/// one of them in silence) and values of another shape are violations.
class Mapping {
 public:
  using Reader = std::function<void(const YAML::Node& key, const YAML::Node& value)>;

  Mapping(std::string what, Violations& violations) : what_(std::move(what)), violations_(violations) {}
  Mapping& key(const std::string& name, Reader reader);
  /// Reads keys that are names chosen by the user.
  Mapping& any(Reader reader);
  /// `line` is where the mapping is spoken of, for what is wrong with it as a whole.
  void read(const YAML::Node& node, int line) const;

 private:
  std::vector<std::string> names() const;

  std::string what_;
  Violations& violations_;
  std::map<std::string, Reader> readers_;
  Reader any_;
};

/// Reads a scalar into a text.
Mapping::Reader text_into(std::string& text, const std::string& what, Violations& violations);

}  // namespace sediment::runner
