#include "pipeline/runner/config/violations.hpp"

#include <algorithm>

#include "pipeline/contract/description.hpp"
#include "pipeline/contract/errors.hpp"

namespace sediment::runner {

void Violations::add(int line, const std::string& text) {
  const std::string place = line > 0 ? file_.string() + ':' + std::to_string(line) : file_.string();
  lines_.push_back(place + ": " + text);
}

void Violations::add_call(const std::string& text) {
  lines_.push_back(text);
}

void Violations::throw_if_any() const {
  if (lines_.empty()) return;
  std::string text;
  for (auto line = lines_.begin(); line != lines_.end(); ++line)
    if (std::find(lines_.begin(), line, *line) == line) text += (text.empty() ? "" : "\n") + *line;
  throw contract::UsageError(text);
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = contract::nearest_name(name, known);
  return nearest.empty() ? "" : " (did you mean \"" + nearest + "\"?)";
}

}  // namespace sediment::runner
