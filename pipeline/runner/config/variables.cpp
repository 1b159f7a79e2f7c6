#include "pipeline/runner/config/variables.hpp"

#include <cctype>
#include <cstdlib>
#include <string_view>

namespace sediment::runner {
namespace {

// Two code points of Unicode's private use area, in UTF-8.
constexpr std::string_view kBegin = "\uE000", kEnd = "\uE001";

bool is_name(std::string_view text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0]))) return false;
  for (const char c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  return true;
}

}  // namespace

std::string mark_variables(const std::string& yaml_text) {
  std::string marked;
  std::size_t at = 0;
  while (true) {
    const std::size_t begin = yaml_text.find("${", at);
    const std::size_t end = begin == std::string::npos ? begin : yaml_text.find('}', begin);
    if (end == std::string::npos) return marked + yaml_text.substr(at);
    const std::string name = yaml_text.substr(begin + 2, end - begin - 2);
    marked += yaml_text.substr(at, begin - at);
    if (is_name(name))
      marked.append(kBegin).append(name).append(kEnd);
    else
      marked += yaml_text.substr(begin, end + 1 - begin);
    at = end + 1;
  }
}

Expansion expand(const std::string& scalar, const Lookup& lookup) {
  Expansion result;
  std::size_t at = 0;
  while (true) {
    const std::size_t begin = scalar.find(kBegin, at);
    const std::size_t end = begin == std::string::npos ? begin : scalar.find(kEnd, begin);
    if (end == std::string::npos) {
      result.text += scalar.substr(at);
      return result;
    }
    const std::string name = scalar.substr(begin + kBegin.size(), end - begin - kBegin.size());
    result.text += scalar.substr(at, begin - at);
    if (const auto value = lookup(name))
      result.text += *value;
    else
      result.unset.push_back(name);
    at = end + kEnd.size();
  }
}

bool begins_with_variable(const std::string& scalar) {
  return scalar.starts_with(kBegin);
}

std::optional<std::string> environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

}  // namespace sediment::runner
