#include "pipeline/runner/commands/command_table.hpp"

namespace sediment::runner {

std::span<const Command> commands() {
  static constexpr Command kCommands[] = {
      {"run", "Bring the results of a pipeline up to date", kLook | kSelection | kThreads | kExecution, run},
      {"sweep", "Run a pipeline over all combinations of sources and parameters, then show one table",
       kLook | kSelection | kThreads | kExecution, sweep},
      {"plan", "Show what a run would do and why, with the exact calls; runs nothing",
       kLook | kSelection | kThreads | kJson, show_plan},
      {"why", "Show in what a stage differs from its last result, part by part",
       kLook | kSelection | kOptionalStage | kJson, show_why},
      {"status", "Show which results are there; runs nothing", kLook | kSelection | kJson, show_status},
      {"cancel", "Cancel what was submitted to Slurm for a pipeline or a sweep", kConfig | kPlaces,
       cancel_jobs},
      {"graph", "Print the pipeline as text, Mermaid, DOT or JSON", kLook | kJson, show_graph},
      {"log", "Print what a stage says now, or said when its result was made or when it last failed",
       kLook | kStage, show_log},
      {"accept",
       "Take the last result of a stage as right for what has changed since; recorded in its receipt",
       kLook | kStage, accept_stage},
      {"pin", "Keep the present results of a pipeline, or of one stage, from being pruned",
       kLook | kOptionalStage, pin},
      {"table", "Tables of sizes, times and metrics from the receipts of a run or a sweep; runs nothing",
       kFolder | kStore, show_table},
      {"compare", "Show in what the results of two runs differ", kFolder | kTwoFolders | kStore, compare},
      {"report", "Write one page (HTML) to look at a run or a sweep; runs nothing", kFolder | kStore, report},
      {"verify", "Check the results in a store by digest; what is damaged is put aside",
       kOptionalConfig | kPlaces, verify_store},
      {"prune", "Remove results from a store by age, size or reachability",
       kOptionalConfig | kPlaces | kPrograms, prune_store},
      {"seal", "Digest a dataset once: later runs trust its manifest.json and look at no other file of it",
       kFolder, seal},
      {"slurm-task", "Do one task of an array job; the batch scripts of --backend slurm call it", kFolder,
       run_slurm_task},
      {"completion", "Print what bash needs to complete calls: source <(sediment completion bash)", 0,
       print_completion},
  };
  return kCommands;
}

}  // namespace sediment::runner
