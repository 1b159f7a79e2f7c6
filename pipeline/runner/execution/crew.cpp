#include "pipeline/runner/execution/crew.hpp"

#include <algorithm>

namespace sediment::runner {

const Crew::Member& Crew::add(Member member) {
  const auto has = [&](const Member& other) { return other.lane == member.lane; };
  while (std::any_of(members_.begin(), members_.end(), has)) ++member.lane;
  free_.take(member.taken);
  return members_.emplace_back(std::move(member));
}

std::optional<Crew::Ended> Crew::take_ended() {
  for (auto member = members_.begin(); member != members_.end(); ++member) {
    const auto ending = reap(member->attempt->pid());
    if (!ending) continue;
    Ended ended{std::move(*member), *ending};
    members_.erase(member);
    end_orphans(ended.member.attempt->log().parent_path());
    free_.give_back(ended.member.taken);
    return ended;
  }
  return std::nullopt;
}

void Crew::signal(int signal) {
  for (const Member& member : members_) signal_group(member.attempt->pid(), signal);
}

}  // namespace sediment::runner
