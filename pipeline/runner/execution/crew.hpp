#pragma once

#include <list>
#include <memory>
#include <optional>

#include "pipeline/runner/config/resources.hpp"
#include "pipeline/runner/execution/attempt.hpp"

namespace sediment::runner {

/// The stages that run at this moment.
class Crew {
 public:
  Crew(int jobs, Amounts capacity) : jobs_(static_cast<std::size_t>(jobs)), free_(std::move(capacity)) {}

  struct Member {
    std::size_t task;
    Amounts taken;
    std::unique_ptr<Attempt> attempt;
    int lane = 0;  ///< set by add(): the lowest that nobody else has
  };
  struct Ended {
    Member member;
    Ending ending;
  };

  bool empty() const { return members_.empty(); }
  bool is_full() const { return members_.size() >= jobs_; }
  bool has_room_for(const Amounts& wanted) const { return !is_full() && free_.suffice(wanted); }
  const Member& add(Member member);
  /// One that has ended, with all its processes; its resources are free again.
  std::optional<Ended> take_ended();
  void signal(int signal);

 private:
  std::size_t jobs_;
  FreeResources free_;
  std::list<Member> members_;
};

}  // namespace sediment::runner
