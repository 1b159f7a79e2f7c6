#pragma once

#include <stdexcept>

namespace sediment::contract {

/// Exit codes of every program of ours.
enum ExitCode { kDone = 0, kFailed = 1, kWrongCall = 2, kInterrupted = 130 };

/// The call or the configuration is wrong: reported on stderr, exit code 2. Any other std::exception is a
/// failure of the work: exit code 1.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sediment::contract
