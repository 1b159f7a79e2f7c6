#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/runner/config/graph.hpp"
#include "pipeline/runner/execution/process.hpp"
#include "pipeline/runner/store/key.hpp"
#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// The call of a stage: every path absolute, of the parameters those that differ from their defaults.
std::vector<std::string> argv_of(const PlannedStage& stage, const std::vector<std::filesystem::path>& inputs,
                                 const std::filesystem::path& out, int threads);

/// One execution of a stage in a private folder: starts it, and if it ends well seals and publishes its
/// result.
class Attempt {
 public:
  /// Starts the stage. The lock of the key belongs to the attempt from now on.
  Attempt(Store& store, KeyLock lock, Key key, const PlannedStage& stage,
          const std::vector<std::filesystem::path>& inputs, int threads, std::string why);
  /// Gives the folder back: all processes of the stage must have ended.
  ~Attempt();
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  pid_t pid() const { return pid_; }
  std::chrono::steady_clock::time_point started() const { return started_; }
  double seconds() const;
  std::filesystem::path log() const { return folder_ / "log"; }
  /// The last line the stage said, for a display.
  std::string last_words() const;
  /// Publishes result and receipt of a stage that ended. Throws std::runtime_error if it failed or its result
  /// is not whole.
  Receipt finish(const Ending& ending);

 private:
  Store& store_;
  KeyLock lock_;
  Key key_;
  std::filesystem::path folder_;
  Receipt receipt_;
  std::chrono::steady_clock::time_point started_;
  pid_t pid_ = -1;
};

}  // namespace sediment::runner
