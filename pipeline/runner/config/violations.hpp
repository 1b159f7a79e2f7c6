#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sediment::runner {

/// All that is wrong with a configuration. It is collected first and reported at once, so that a config with
/// five mistakes takes one round to correct.
class Violations {
 public:
  explicit Violations(std::filesystem::path file) : file_(std::move(file)) {}

  /// A mistake in the file, at a line counted from 1.
  void add(int line, const std::string& text);
  /// A mistake in the call itself (`--set`, the environment).
  void add_call(const std::string& text);

  bool empty() const { return lines_.empty(); }
  /// Throws contract::UsageError with one line per mistake, if there is any.
  void throw_if_any() const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> lines_;
};

/// ` (did you mean "segment"?)`, or nothing if no known name is near.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known);

}  // namespace sediment::runner
