#pragma once

#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "pipeline/runner/execution/board.hpp"
#include "pipeline/runner/execution/crew.hpp"
#include "pipeline/runner/execution/signals.hpp"

namespace sediment::runner {

struct RunOptions {
  int jobs = 1;
  int threads = 0;   ///< given to each stage that declares no cpus, 0 = all cores
  Amounts capacity;  ///< of the machine
  bool keep_going = false;
  bool check_space = true;    ///< refuse to begin if the last results would not fit on the disk
  std::filesystem::path run;  ///< folder for the logs of failed stages
};

/// Brings every selected stage of the instances up to date. One thread does it all: it decides, starts, waits
/// and publishes; only the stages are other processes.
class Scheduler {
 public:
  Scheduler(const std::vector<Instance>& instances, Store& store, RunOptions options, Signals& signals,
            Display& display);

  /// Returns the tasks with their outcomes; those nothing needs are left out.
  std::vector<Task> run();
  bool interrupted() const { return interrupted_; }

 private:
  struct Waiting {  ///< ready to run, or to try the lock of another runner again
    std::size_t task;
    Key key;
  };
  enum class Launch { done, no_room, locked };

  void decide(std::size_t task);
  void launch_ready();
  Launch launch(Waiting& waiting);
  void start(Waiting& waiting, KeyLock lock);
  void wait();
  void publish(Crew::Ended ended);
  bool retries(const Crew::Ended& ended, const std::string& what);
  std::string save_log(const Task& task, const std::filesystem::path& log) const;
  void fail(std::size_t task, const std::string& what);
  void release_followers(const std::string& key);
  void interrupt();
  void check_space();

  Store& store_;
  RunOptions options_;
  Signals& signals_;
  Display& display_;
  Board board_;
  Crew crew_;
  std::deque<Waiting> ready_;
  std::unordered_map<std::string, std::vector<std::size_t>>
      followers_;  ///< by key in work: others that want it
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool space_checked_ = false;
  bool locked_out_ = false;  ///< another runner holds a lock we want
  bool stopping_ = false;    ///< something failed: start nothing more
  bool interrupted_ = false;
};

}  // namespace sediment::runner
