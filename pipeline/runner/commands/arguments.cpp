#include "pipeline/runner/commands/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/config/violations.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::UsageError;

void add_selection(CLI::App& app, Arguments& arguments) {
  auto* only = app.add_option("--only", arguments.only, "This stage alone")->type_name("STAGE");
  app.add_option("--from", arguments.from, "This stage and those behind it")
      ->type_name("STAGE")
      ->excludes(only);
  app.add_option("--until", arguments.until, "This stage and those it needs")
      ->type_name("STAGE")
      ->excludes(only);
}

void add_config(CLI::App& app, Arguments& arguments, unsigned takes) {
  if (takes & kFolder) app.add_option("folder", arguments.config, "Folder")->required();
  if (takes & kTwoFolders) app.add_option("other", arguments.other, "Folder to compare it with")->required();
  if (takes & (kConfig | kOptionalConfig))
    app.add_option("config", arguments.config, "Pipeline: a YAML file, or a folder with a pipeline.yaml")
        ->required(takes & kConfig);
  if (takes & (kStage | kOptionalStage))
    app.add_option("stage", arguments.stage, takes & kStage ? "Stage" : "Stage [all]")
        ->required(takes & kStage);
  if (takes & kConfig)
    app.add_option("--set", arguments.set,
                   "A value of this call: stage.parameter=value or source=path; repeatable")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
}

void add_report_flags(CLI::App& app, Arguments& arguments) {
  app.add_option("--page", arguments.page, "File to write [FOLDER/report.html]")->type_name("FILE");
  app.add_option("--facts", arguments.facts, "Write what receipts know as JSON instead of a page")
      ->type_name("FILE");
  app.add_option("--points", arguments.points, "Points on the whole page; clouds with more are thinned")
      ->check(CLI::Range(1000, 20'000'000))
      ->capture_default_str();
  app.add_option("--frames", arguments.frames, "Pictures on the whole page, spread over the sequences")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
}

void add_places(CLI::App& app, Arguments& arguments) {
  app.add_option("--out", arguments.out, "Folder that gets a link to each result [out/<pipeline>]")
      ->type_name("DIR");
  app.add_option("--store", arguments.store,
                 "Folder that holds the results [$SEDIMENT_STORE, else OUT/.sediment]")
      ->type_name("DIR");
}

void add_programs(CLI::App& app, Arguments& arguments) {
  app.add_option("--stages", arguments.stages, "Folder of the stages' programs [that of sediment]")
      ->type_name("DIR");
  app.add_flag("--rehash", arguments.rehash, "Read every source anew instead of trusting its size and times");
}

void add_run_flags(CLI::App& app, Arguments& arguments) {
  app.add_option("-j,--jobs", arguments.jobs, "Stages that run at the same time, 0 = one per core [0]")
      ->check(CLI::Range(0, 1024));
  app.add_flag("-k,--keep-going", arguments.keep_going,
               "After a failure go on with what does not depend on it");
  app.add_option("--resource", arguments.resources,
                 "What stages may take in all [cpus and memory of this machine]")
      ->type_name("NAME=AMOUNT")
      ->allow_extra_args(false);
  app.add_flag("--durable", arguments.durable,
               "Wait until each result is on the disk (fsync) before it counts");
  app.add_flag("--no-space-check", arguments.no_space_check,
               "Begin even if results as large as the last ones would not fit on the disk");
}

void add_slurm_flags(CLI::App& app, Arguments& arguments) {
  auto* backend = app.add_option("--backend", arguments.backend,
                                 "Where stages run: local (this machine) or slurm [local]")
                      ->check(CLI::IsMember({"local", "slurm"}));
  app.add_option(
         "--pack", arguments.pack,
         "What one task of Slurm does: sequence (an instance), stage, or chunk:N (N instances) [sequence]")
      ->needs(backend);
  app.add_option("--profile", arguments.profile,
                 "What the cluster wants to be told, a YAML file [$SEDIMENT_SLURM_PROFILE]")
      ->needs(backend)
      ->type_name("FILE");
  app.add_option("--in-flight", arguments.in_flight, "Tasks of Slurm at the same time, per layer [no limit]")
      ->needs(backend)
      ->check(CLI::Range(1, 1'000'000));
  app.add_flag("--wait", arguments.wait, "Stay until Slurm is through; submit again what it lost")
      ->needs(backend);
}

void add_table_flags(CLI::App& app, Arguments& arguments) {
  app.add_option("--value", arguments.values,
                 "stage.bytes, .seconds, .cpu_seconds, .memory, .FILE or .METRIC; a ratio of two; a [unit] "
                 "behind it; "
                 "without a stage: a row per stage. Repeatable [stage.bytes of each stage]")
      ->type_name("VALUE")
      ->allow_extra_args(false);
  app.add_option("--row", arguments.rows,
                 "An axis of the sweep, or stage; repeatable [all that are no columns]")
      ->type_name("AXIS")
      ->allow_extra_args(false);
  app.add_option("--columns", arguments.columns, "An axis of which every value gets its own columns")
      ->type_name("AXIS");
  app.add_option("--aggregate", arguments.aggregate, "mean, sum, min or max of what falls into one cell")
      ->check(CLI::IsMember({"mean", "sum", "min", "max"}));
  app.add_option("--format", arguments.format, "markdown, csv, json or latex [markdown]")
      ->check(CLI::IsMember({"markdown", "csv", "json", "latex"}));
}

/// Flags that one command alone has.
void add_own_flags(CLI::App& app, const std::string& name, Arguments& arguments) {
  if (name == "report") add_report_flags(app, arguments);
  if (name == "completion") {
    app.add_option("what", arguments.what, "bash; or of a pipeline: stages, settings")
        ->required()
        ->check(CLI::IsMember({"bash", "stages", "settings"}));
    app.add_option("config", arguments.config, "Pipeline");
  }
  if (name == "graph")
    app.add_option("--format", arguments.format, "text, mermaid or dot [text]")
        ->check(CLI::IsMember({"text", "mermaid", "dot"}));
  if (name == "verify")
    app.add_option("--share", arguments.share, "Share of the results to read, 0 .. 1; picked at random [1]")
        ->check(CLI::Range(0.0, 1.0));
  if (name == "pin" || name == "seal") app.add_flag("--remove", arguments.remove, "Undo it");
  if (name == "table") add_table_flags(app, arguments);
  if (name == "run" || name == "sweep") add_slurm_flags(app, arguments);
  if (name == "slurm-task") {
    app.add_option("array", arguments.array, "Number of the array job")->required();
    app.add_option("--index", arguments.index, "Task of it [$SLURM_ARRAY_TASK_ID]")
        ->envname("SLURM_ARRAY_TASK_ID")
        ->required();
  }
  if (name != "prune") return;
  app.add_option("--older-than", arguments.older_than, "Results made longer ago: 90s, 15m, 2h, 30d")
      ->type_name("AGE");
  app.add_option("--max-size", arguments.max_size, "The oldest results until the rest is no larger: 20 GB")
      ->type_name("SIZE");
  app.add_option("--keep", arguments.keep, "All results but those these pipelines would use now; repeatable")
      ->type_name("CONFIG")
      ->allow_extra_args(false);
  app.add_flag("--dry-run", arguments.dry_run, "Only say what would be removed");
}

void add_command(CLI::App& root, const Command& command, Arguments& arguments) {
  CLI::App& app = *root.add_subcommand(command.name, command.help);
  const unsigned takes = command.takes;
  add_config(app, arguments, takes);
  if (takes & kPlaces) add_places(app, arguments);
  if (takes & kStore)
    app.add_option("--store", arguments.store,
                   "Folder that holds the results [$SEDIMENT_STORE, else FOLDER/.sediment]")
        ->type_name("DIR");
  if (takes & kPrograms) add_programs(app, arguments);
  if (takes & kSelection) add_selection(app, arguments);
  if (takes & kThreads)
    app.add_option("--threads", arguments.threads,
                   "Threads of each stage, 0 = all cores; never changes a result [0]")
        ->check(CLI::Range(0, 1024));
  if (takes & kExecution) add_run_flags(app, arguments);
  if (takes & kJson) app.add_flag("--json", arguments.json, "Print JSON");
  add_own_flags(app, command.name, arguments);
  app.callback([&arguments, &command] { arguments.command = &command; });
}

std::string unknown_command(const std::string& name) {
  std::vector<std::string> known;
  for (const Command& command : commands()) known.push_back(command.name);
  return "unknown command \"" + name + "\"" + did_you_mean(name, known);
}

}  // namespace

void declare_commands(CLI::App& app, Arguments& arguments) {
  app.name("sediment");
  app.set_version_flag("--version", SEDIMENT_VERSION);
  for (const Command& command : commands()) add_command(app, command, arguments);
}

std::optional<Arguments> parse_arguments(int argc, char** argv) {
  CLI::App app("Runs pipelines of stages; keeps every result that is still right");
  Arguments arguments;
  declare_commands(app, arguments);
  const auto is_first = [&](const Command& command) { return std::string(command.name) == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && std::none_of(commands().begin(), commands().end(), is_first))
    throw UsageError(unknown_command(argv[1]));
  app.require_subcommand(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    app.exit(success, std::cout);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  // `sediment why sor configs/paper` means the same as `sediment why configs/paper sor`.
  if (!arguments.stage.empty() && !fs::exists(arguments.config) && fs::exists(arguments.stage)) {
    const std::string stage = arguments.config.string();
    arguments.config = arguments.stage;
    arguments.stage = stage;
  }
  return arguments;
}

}  // namespace sediment::runner
