#pragma once

#include <chrono>
#include <list>
#include <set>
#include <string>
#include <vector>

#include "pipeline/runner/execution/attempt.hpp"
#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

/// What a run says while it works, on stderr: on a terminal a live line per stage
/// that runs, plain lines in a pipe.
class Display {
 public:
  Display();

  void begin(std::size_t tasks);
  /// `expected_s`: what it took the last time, 0 if that is not known.
  void started(const Task& task, const Attempt& attempt, double expected_s);
  void retries(const Task& task, const std::string& what, int allowed);
  void stopped(const Task& task);  ///< it runs no longer; its attempt is about to go
  void waits(const Task& task);    ///< for the same result, which another runner makes
  void ended(const Task& task);
  void tick();
  void end();

 private:
  struct Running {
    const std::string* label;
    const Attempt* attempt;
    double expected_s;
    std::string text() const;
  };

  void say(const std::string& line);
  void clear();
  void draw();
  std::vector<std::string> live_lines() const;

  bool terminal_;
  std::size_t drawn_ = 0;  ///< lines on the terminal that the next drawing replaces
  std::size_t tasks_ = 0, ended_ = 0;
  std::list<Running> running_;
  std::set<std::string> told_;  ///< labels that wait and were reported
  std::chrono::steady_clock::time_point shown_;
};

}  // namespace sediment::runner
