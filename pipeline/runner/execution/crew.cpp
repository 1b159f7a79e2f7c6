#include "pipeline/runner/execution/crew.hpp"

namespace sediment::runner {

const Attempt& Crew::add(Member member) {
  free_.take(member.taken);
  members_.push_back(std::move(member));
  return *members_.back().attempt;
}

std::optional<Crew::Ended> Crew::take_ended() {
  for (auto member = members_.begin(); member != members_.end(); ++member) {
    const auto ending = reap(member->attempt->pid());
    if (!ending) continue;
    Ended ended{std::move(*member), *ending};
    members_.erase(member);
    free_.give_back(ended.member.taken);
    return ended;
  }
  return std::nullopt;
}

void Crew::signal(int signal) {
  for (const Member& member : members_) signal_group(member.attempt->pid(), signal);
}

}  // namespace sediment::runner
