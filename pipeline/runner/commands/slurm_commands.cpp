#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/opened_config.hpp"
#include "pipeline/runner/commands/slurm_setup.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/slurm/task_run.hpp"

namespace sediment::runner {

namespace fs = std::filesystem;

slurm::Setup slurm_setup_of(const Arguments& arguments) {
  if (!arguments.resources.empty())
    throw contract::UsageError(
        "--resource is what this machine has; on Slurm the profile and the stages say it");
  slurm::Setup setup;
  setup.packing = slurm::packing_from(arguments.pack);
  const fs::path profile = arguments.profile.empty()
                               ? fs::path(environment("SEDIMENT_SLURM_PROFILE").value_or(""))
                               : arguments.profile;
  if (!profile.empty()) setup.profile = slurm::read_profile(profile);
  setup.in_flight = arguments.in_flight;
  setup.manner = {arguments.jobs, arguments.threads, arguments.durable, !arguments.no_space_check};
  return setup;
}

int cancel_jobs(const Arguments& arguments) {
  slurm::check_commands();
  const Store store(store_of(arguments));
  const std::string out = out_of(arguments).string();
  const slurm::Observed observed = slurm::observe(store);
  if (!observed.silence.empty()) throw std::runtime_error(observed.silence);
  std::set<std::string> jobs;
  std::size_t tasks = 0;
  for (const slurm::Submission& submission : observed.submissions) {
    if (submission.out != out) continue;
    const std::size_t before = jobs.size();
    for (const std::string& name : submission.names) {
      const auto array = observed.queue.find(name);
      if (array == observed.queue.end()) continue;
      for (const auto& [index, task] : array->second) {
        if (!task.is_alive()) continue;
        jobs.insert(task.job.substr(0, task.job.find('_')));
        ++tasks;
      }
    }
    if (jobs.size() > before) slurm::note_cancelled(submission);
  }
  slurm::cancel({jobs.begin(), jobs.end()});
  fmt::print("{} tasks of {} array jobs cancelled\n", tasks, jobs.size());
  return contract::kDone;
}

int run_slurm_task(const Arguments& arguments) {
  return slurm::run_task(fs::absolute(arguments.config).lexically_normal(), arguments.array, arguments.index);
}

}  // namespace sediment::runner
