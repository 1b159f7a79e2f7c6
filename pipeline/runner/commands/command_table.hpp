#pragma once

#include <span>

#include "pipeline/runner/commands/arguments.hpp"

namespace sediment::runner {

/// What a command takes besides its own flags; a sum of these.
enum Takes : unsigned {
  kConfig = 1,          ///< a pipeline, with --set
  kOptionalConfig = 2,  ///< a pipeline that only says where the store is
  kFolder = 4,          ///< a folder instead
  kStage = 8,           ///< a stage behind the pipeline
  kOptionalStage = 16,
  kPlaces = 32,      ///< --out, --store
  kPrograms = 64,    ///< --stages, --rehash
  kSelection = 128,  ///< --only, --from, --until
  kThreads = 256,
  kExecution = 512,  ///< -j, --keep-going, ...
  kJson = 1024,
  kStore = 2048,  ///< --store alone
  kTwoFolders = 4096,
  kLook = kConfig | kPlaces | kPrograms,
};

struct Command {
  const char* name;
  const char* help;
  unsigned takes;
  int (*carry_out)(const Arguments&);  ///< returns the exit code
};

/// Every command of `sediment`: the help, the parser and main all read this table.
std::span<const Command> commands();

// In the files named after them.
int report(const Arguments& arguments);
int run(const Arguments& arguments);
int show_plan(const Arguments& arguments);
int show_why(const Arguments& arguments);
int show_graph(const Arguments& arguments);
int show_status(const Arguments& arguments);
int show_log(const Arguments& arguments);
int accept_stage(const Arguments& arguments);
int pin(const Arguments& arguments);
int verify_store(const Arguments& arguments);
int prune_store(const Arguments& arguments);
int seal(const Arguments& arguments);
int sweep(const Arguments& arguments);
int show_table(const Arguments& arguments);
int compare(const Arguments& arguments);
int cancel_jobs(const Arguments& arguments);
int run_slurm_task(const Arguments& arguments);
int print_completion(const Arguments& arguments);

}  // namespace sediment::runner
