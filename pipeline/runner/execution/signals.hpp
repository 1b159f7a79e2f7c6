#pragma once

#include <chrono>
#include <optional>

namespace sediment::runner {

/// Signals as events of the scheduler's loop. Make it before any thread: it blocks them for the whole
/// process.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  struct Seen {
    bool child_ended = false;
    bool interrupted = false;  ///< ^C, SIGTERM or SIGHUP, or the time set below has come
  };
  Seen wait(int limit_ms);
  void interrupt_again_after(double seconds);

 private:
  int descriptor_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

}  // namespace sediment::runner
