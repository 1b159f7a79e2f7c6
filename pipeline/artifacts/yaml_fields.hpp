#pragma once

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sediment {

/// A mapping of a YAML file that is read strictly: errors name file and line.
class YamlFields {
 public:
  /// Throws std::runtime_error if the node is no mapping or has a key that is not `known`, or one twice.
  YamlFields(std::string file, YAML::Node node, std::initializer_list<std::string_view> known);

  bool has(const char* key) const { return node_[key].IsDefined(); }
  YAML::Node node(const char* key) const { return node_[key]; }

  /// Throws std::runtime_error if the key is missing or its value does not fit.
  template <class Value>
  Value require(const char* key) const {
    if (!has(key)) fail(node_, std::string("\"") + key + "\" is missing");
    try {
      return node_[key].template as<Value>();
    } catch (const YAML::Exception&) {
      fail(node_[key], std::string("the value of \"") + key + "\" cannot be read");
    }
  }
  template <class Value>
  Value get(const char* key, Value otherwise) const {
    return has(key) ? require<Value>(key) : otherwise;
  }

  /// Throws std::runtime_error "file:line: what".
  [[noreturn]] void fail(const YAML::Node& at, const std::string& what) const;
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  YAML::Node node_;
};

/// Parses YAML text; `file` is for errors. Throws std::runtime_error with file and line.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

}  // namespace sediment
