#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/slurm/request.hpp"
#include "pipeline/runner/slurm/work.hpp"

namespace sediment::runner::slurm {

/// `--pack sequence`, `stage` or `chunk:N`.
struct Packing {
  bool by_stage = false;
  std::size_t instances = 1;  ///< per element, if not by stage
};
/// Throws contract::UsageError.
Packing packing_from(const std::string& text);

/// What one task of an array job does, one process on one machine.
struct Element {
  std::vector<std::size_t> works;
  std::vector<std::size_t> waits_for;       ///< elements; without those that others of them wait for
  std::vector<std::string> waits_for_jobs;  ///< submitted before: "12_3"
  std::size_t layer = 0;                    ///< of those it waits for the highest, and one
  Request request;
};

/// Works to submit, and those that are in flight already.
struct Submittable {
  std::vector<bool> open;                   ///< by work: to be submitted now
  std::map<std::size_t, std::string> jobs;  ///< by work: in flight, "12_3"
  std::map<std::size_t, int> attempts;      ///< by work: attempts that failed or were lost
};

/// Groups the open works. By stage each work is an element. Else what only one group of instances needs is
/// the element of this group, and what several groups need is an element before theirs: one for all works
/// with the same groups.
std::vector<Element> pack(const std::vector<Work>& works, const std::vector<Instance>& instances,
                          const Submittable& submittable, const Packing& packing, const Profile& profile);

}  // namespace sediment::runner::slurm
