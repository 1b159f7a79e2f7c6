#include "pipeline/runner/slurm/request.hpp"

#include <algorithm>

#include "pipeline/contract/errors.hpp"

namespace sediment::runner::slurm {

Request request_of(const PlannedStage& stage, const Profile& profile, int attempt) {
  Request request;
  request.amounts = stage.resources.amounts;
  request.amounts.insert(profile.defaults.amounts.begin(), profile.defaults.amounts.end());
  request.amounts.try_emplace("cpus", 1);
  if (const auto memory = request.amounts.find("memory"); memory != request.amounts.end())
    memory->second <<= std::min(attempt, stage.resources.retries);
  request.time_s = stage.resources.time_s > 0 ? stage.resources.time_s : profile.defaults.time_s;
  request.options = profile.options;
  if (const auto own = profile.stages.find(stage.name); own != profile.stages.end())
    request.options.insert(request.options.end(), own->second.begin(), own->second.end());
  return request;
}

void add(Request& request, const Request& stage, const std::string& name) {
  if (request.options != stage.options)
    throw contract::UsageError("stage " + name +
                               " has other options in the profile than the stages it would share an element "
                               "with: give --pack stage");
  for (const auto& [resource, amount] : stage.amounts)
    request.amounts[resource] = std::max(request.amounts[resource], amount);
  // A stage without a limit leaves the element without one.
  const bool limited = request.time_s > 0 && stage.time_s > 0;
  request.time_s = limited ? request.time_s + stage.time_s : 0;
}

std::vector<std::string> flags_of(const Request& request) {
  constexpr std::uint64_t kMiB = 1 << 20;
  std::vector<std::string> flags{"--nodes=1", "--ntasks=1"};
  std::string licences;
  for (const auto& [name, amount] : request.amounts) {
    if (name == "cpus")
      flags.push_back("--cpus-per-task=" + std::to_string(amount));
    else if (name == "memory")
      flags.push_back("--mem=" + std::to_string((amount + kMiB - 1) / kMiB) + 'M');
    else if (name == "gpus")
      flags.push_back("--gres=gpu:" + std::to_string(amount));
    else
      licences += (licences.empty() ? "" : ",") + name + ':' + std::to_string(amount);
  }
  if (!licences.empty()) flags.push_back("--licenses=" + licences);
  if (request.time_s > 0) flags.push_back("--time=" + std::to_string((request.time_s + 59) / 60));
  flags.insert(flags.end(), request.options.begin(), request.options.end());
  return flags;
}

}  // namespace sediment::runner::slurm
