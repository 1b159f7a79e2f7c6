#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sediment::runner {

/// A program to start: no shell, a fixed environment, input from /dev/null.
struct Launch {
  std::vector<std::string> argv;  ///< argv[0] is the path of the executable
  std::vector<std::string> environment;
  std::filesystem::path folder;  ///< working folder
  int out = -1;                  ///< open file of stdout
  int err = -1;                  ///< open file of stderr
};

/// How a program ended, and what it took.
struct Ending {
  int exit_code = 0;  ///< 128 + signal if it was killed
  int signal = 0;     ///< 0 if it left by itself
  double cpu_s = 0;   ///< user and system, of all its processes
  /// Largest resident set of one of its processes. The kernel counts from the fork on, so that this is never
  /// less than the memory of the runner at that moment.
  std::uint64_t peak_bytes = 0;
};

/// Starts the program in a process group of its own. It is killed when the calling THREAD ends
/// (PR_SET_PDEATHSIG watches the thread, not the process): call from the main thread only. Throws
/// std::runtime_error naming the program if it cannot be started.
pid_t start(const Launch& launch);

/// The ending of a started program if it has ended; does not wait. What is left of its process group is
/// killed.
std::optional<Ending> reap(pid_t pid);

/// From now on a process whose parent ended becomes our child, even if it has left its group.
void adopt_orphans();

/// Kills every adopted process that has this home in its environment (fixed_environment): what a stage that
/// ended has left behind outside its group.
void end_orphans(const std::filesystem::path& home);

/// Signals the whole process group.
void signal_group(pid_t pid, int signal);

/// The environment of every stage, whatever the user's is: results must not depend on it.
std::vector<std::string> fixed_environment(const std::filesystem::path& home);

/// Runs a short program to its end and returns its stdout. Throws std::runtime_error if it fails, with what
/// it said, or takes longer than `limit_s`.
std::string output_of(const std::vector<std::string>& argv, int limit_s,
                      const std::vector<std::string>& environment = fixed_environment("/"));

}  // namespace sediment::runner
