#include "pipeline/runner/slurm/batch_script.hpp"

#include <stdexcept>

#include "pipeline/runner/config/program.hpp"

namespace sediment::runner::slurm {
namespace {

std::string shell_quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + '\'';
}

/// sbatch reads its own lines: blanks end a word unless it is quoted, and in names of files % begins a
/// pattern.
std::string directive(const std::string& flag) {
  if (flag.find_first_of("\n\"\\") != std::string::npos)
    throw std::runtime_error("cannot tell sbatch " + flag + ": it has a quote, a backslash or a line break");
  return "#SBATCH " + (flag.find_first_of(" \t#'") == std::string::npos ? flag : '"' + flag + '"') + '\n';
}

}  // namespace

std::string text_of(const BatchScript& script, const Array& array) {
  const std::string folder = script.submission.string();
  const std::string cap = script.in_flight > 0 ? '%' + std::to_string(script.in_flight) : "";
  std::vector<std::string> flags{"--job-name=" + script.name, "--array=" + index_text(array) + cap,
                                 "--chdir=" + folder, "--output=logs/%A_%a", "--no-requeue"};
  if (!script.dependency.empty()) {
    flags.push_back("--dependency=" + script.dependency);
    flags.push_back("--kill-on-invalid-dep=yes");
  }
  for (const std::string& flag : flags_of(array.request)) flags.push_back(flag);
  std::string text = "#!/bin/sh\n";
  for (const std::string& flag : flags) text += directive(flag);
  // exec: the runner takes the place of the shell, so that it gets the signals.
  return text + "exec " + shell_quoted((own_folder() / "sediment").string()) + " slurm-task " +
         shell_quoted(folder) + ' ' + std::to_string(script.number) + '\n';
}

std::string dependency_of(const Array& array, const SubmittedArrays& submitted) {
  std::string text, tasks;
  for (const std::size_t before : array.follows) text += ",aftercorr:" + submitted.jobs[before];
  for (const std::size_t element : array.waits_for) {
    const auto& [other, index] = submitted.element_at[element];
    tasks += ':' + submitted.jobs[other] + '_' + std::to_string(index);
  }
  for (const std::string& job : array.waits_for_jobs) tasks += ':' + job;
  if (!tasks.empty()) text += ",afterok" + tasks;
  return text.empty() ? "" : text.substr(1);
}

}  // namespace sediment::runner::slurm
