#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sediment::benchmark {

struct Timed {
  double seconds = 0;
  double peak_mb = 0;  ///< largest resident set of the program itself
  std::string output;  ///< stdout and stderr
};

/// Runs a program in a folder to its end, its output into a file. Throws std::runtime_error with the output
/// if it does not exit with 0.
Timed timed_call(const std::vector<std::string>& argv, const std::filesystem::path& folder);

/// Whether a program is found in the PATH.
bool is_installed(const std::string& program);

}  // namespace sediment::benchmark
