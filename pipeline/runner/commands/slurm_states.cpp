#include "pipeline/runner/commands/slurm_states.hpp"

#include <algorithm>

#include "pipeline/runner/slurm/backend.hpp"

namespace sediment::runner {
namespace {

SlurmStates::One shown(const slurm::Progress& progress) {
  SlurmStates::One one{slurm::name_of(progress.state), progress.why, progress.job};
  if (progress.state == slurm::State::pending && !progress.why.empty()) {
    one.state += " (" + progress.why + ')';
    one.why.clear();
  }
  if (!progress.job.empty() && !progress.is_there())
    one.why += (one.why.empty() ? "job " : "; job ") + one.job;
  if (!progress.log.empty()) one.why += "; " + progress.log;
  return one;
}

}  // namespace

SlurmStates slurm_states(const Look& look) {
  SlurmStates states;
  Store& store = *look.opened.store;
  const slurm::Observed observed = slurm::observe(store);
  if (observed.submissions.empty()) return states;
  const auto works = slurm::works_of(look.opened.instances, store);
  const auto progress = slurm::progress_of(works, look.opened.instances, observed, store);
  const auto was_submitted = [](const slurm::Progress& one) {
    return one.state != slurm::State::cached && one.state != slurm::State::open;
  };
  if (std::none_of(progress.begin(), progress.end(), was_submitted)) return states;
  for (std::size_t w = 0; w < works.size(); ++w)
    for (const slurm::Place& place : works[w].places)
      if (progress[w].state != slurm::State::open)
        states.by_place[{place.instance_idx, place.stage_idx}] = shown(progress[w]);
  states.summary = slurm::summary(progress) + '\n';
  if (!observed.silence.empty()) states.summary += "squeue does not answer: " + observed.silence + '\n';
  return states;
}

}  // namespace sediment::runner
