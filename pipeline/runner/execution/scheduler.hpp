#pragma once

#include <deque>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "pipeline/runner/execution/attempt.hpp"
#include "pipeline/runner/execution/display.hpp"
#include "pipeline/runner/execution/instance.hpp"
#include "pipeline/runner/execution/plan.hpp"
#include "pipeline/runner/execution/signals.hpp"
#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

struct RunOptions {
  int jobs = 1;
  int threads = 0;  ///< given to each stage, 0 = all cores
  bool keep_going = false;
  bool check_space = true;     ///< refuse to begin if the last results would not fit on the disk
  std::filesystem::path logs;  ///< folder for the logs of failed stages
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
  struct Running {
    std::size_t task;
    std::string key;
    std::unique_ptr<Attempt> attempt;
  };
  struct Waiting {  ///< ready to run, or to try the lock of another runner again
    std::size_t task;
    Key key;
  };

  void decide(std::size_t task);
  bool launch(Waiting waiting);
  void launch_ready();
  void wait();
  void reap_ended();
  void publish(Running& running, const Ending& ending);
  void keep(std::size_t task, const Hit& hit);
  void succeed(std::size_t task, Outcome outcome);
  void end(std::size_t task, Outcome outcome);
  void fail(std::size_t task, const std::string& what);
  void block_dependents(std::size_t task);
  void release_followers(const std::string& key);
  void interrupt();
  std::string reason(const Task& task, const Key& key);
  const std::map<std::string, StageRecord>& record(std::size_t instance_idx);
  void check_space();

  const std::vector<Instance>& instances_;
  Store& store_;
  RunOptions options_;
  Signals& signals_;
  Display& display_;
  std::vector<Task> tasks_;
  std::vector<std::vector<std::string>> objects_;  ///< of each stage of each instance, as far as known
  std::map<std::size_t, std::map<std::string, StageRecord>> records_;  ///< of the last run, read on demand
  std::set<std::size_t> undecided_;                                    ///< all before them has ended
  std::deque<Waiting> ready_;
  std::list<Running> running_;
  std::map<std::string, std::vector<std::size_t>> followers_;  ///< by key in work: others that want the same
  bool space_checked_ = false;
  bool locked_out_ = false;  ///< another runner holds a lock we want
  bool stopping_ = false;    ///< something failed: start nothing more
  bool interrupted_ = false;
};

}  // namespace sediment::runner
