#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sediment::runner {

struct Command;

/// A call of `sediment`, understood.
struct Arguments {
  const Command* command = nullptr;
  std::filesystem::path config;  ///< or the folder of seal
  std::string stage;
  std::filesystem::path page, facts;  ///< of report
  int points = 400'000, frames = 60;  ///< of report
  std::string only, from, until;
  std::vector<std::string> set;
  std::vector<std::string> resources;        ///< what this machine has, name=amount
  std::filesystem::path out, store, stages;  ///< empty: their defaults
  int jobs = 0;                              ///< 0 = one per core
  int threads = 0;                           ///< 0 = all cores
  bool keep_going = false, rehash = false, durable = false, no_space_check = false, json = false;
  double share = 1;     ///< of verify
  bool remove = false;  ///< of pin and seal
  std::string older_than, max_size;
  std::vector<std::string> keep;  ///< pipelines whose results prune leaves
  bool dry_run = false;
  std::filesystem::path other;            ///< the second folder of compare
  std::vector<std::string> values, rows;  ///< of table
  std::string columns, aggregate;
  std::string format = "text";  ///< of graph
  std::string backend = "local", pack = "sequence";
  std::filesystem::path profile;  ///< of a cluster
  int in_flight = 0;              ///< tasks of Slurm at the same time, 0 = as the profile says
  bool wait = false;
  std::size_t array = 0, index = 0;  ///< of slurm-task
  std::string what;                  ///< of completion
};

/// Declares every command with its flags: parser, help and completion read this one declaration.
void declare_commands(CLI::App& app, Arguments& arguments);

/// Answers --help and --version itself: then there is nothing left to do. Throws contract::UsageError.
std::optional<Arguments> parse_arguments(int argc, char** argv);

}  // namespace sediment::runner
