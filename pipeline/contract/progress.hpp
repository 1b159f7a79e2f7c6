#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace sediment::contract {

/// Progress of long work on stderr: a bar that is redrawn on a terminal, a plain line now and then in a pipe.
/// Safe to advance from several threads.
class Progress {
 public:
  /// `what` names the work and its unit: {"segment", 160, "frames"}.
  Progress(std::string name, std::size_t total, std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::size_t steps = 1);

 private:
  void show(std::size_t done, bool last);

  std::string name_;
  std::size_t total_;
  std::string unit_;
  bool terminal_;
  std::chrono::steady_clock::time_point started_, shown_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
};

}  // namespace sediment::contract
