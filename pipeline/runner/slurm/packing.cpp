#include "pipeline/runner/slurm/packing.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "pipeline/contract/errors.hpp"

namespace sediment::runner::slurm {
namespace {

using Groups = std::vector<std::size_t>;

/// The number of the group of every instance that has something open, in the order of the instances.
std::map<std::size_t, std::size_t> groups_of(const std::vector<Work>& works, const std::vector<bool>& open,
                                             std::size_t instances_per_group) {
  std::map<std::size_t, std::size_t> groups;
  for (std::size_t w = 0; w < works.size(); ++w)
    for (const Place& place : works[w].places)
      if (open[w]) groups[place.instance_idx] = 0;
  std::size_t count = 0;
  for (auto& [instance, group] : groups) group = count++ / instances_per_group;
  return groups;
}

Groups needed_by(const Work& work, const std::map<std::size_t, std::size_t>& groups) {
  Groups all;
  for (const Place& place : work.places) all.push_back(groups.at(place.instance_idx));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The element of each open work. Two elements never wait for each other: the groups that need a work also
/// need all works before it.
std::map<std::size_t, std::size_t> assign(const std::vector<Work>& works, const std::vector<bool>& open,
                                          const Packing& packing) {
  const auto groups = groups_of(works, open, packing.instances);
  std::map<Groups, std::size_t> by_groups;
  std::map<std::size_t, std::size_t> element_of;
  for (std::size_t w = 0; w < works.size(); ++w) {
    if (!open[w]) continue;
    const std::size_t fresh = packing.by_stage ? element_of.size() : by_groups.size();
    element_of[w] =
        packing.by_stage ? fresh : by_groups.try_emplace(needed_by(works[w], groups), fresh).first->second;
  }
  return element_of;
}

bool waits_for(const std::vector<Element>& elements, std::size_t from, std::size_t to) {
  const auto& before = elements[from].waits_for;
  return std::any_of(before.begin(), before.end(), [&](std::size_t one) {
    return one == to || (elements[one].layer > elements[to].layer && waits_for(elements, one, to));
  });
}

/// Layers from the first to the last; each round sets those whose predecessors are set.
void set_layers(std::vector<Element>& elements) {
  std::vector<std::size_t> missing(elements.size());
  std::vector<std::vector<std::size_t>> behind(elements.size());
  std::vector<std::size_t> ready;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    missing[e] = elements[e].waits_for.size();
    for (const std::size_t before : elements[e].waits_for) behind[before].push_back(e);
    if (missing[e] == 0) ready.push_back(e);
  }
  while (!ready.empty()) {
    const std::size_t e = ready.back();
    ready.pop_back();
    for (const std::size_t next : behind[e]) {
      elements[next].layer = std::max(elements[next].layer, elements[e].layer + 1);
      if (--missing[next] == 0) ready.push_back(next);
    }
  }
}

void drop_implied(std::vector<Element>& elements) {
  for (Element& element : elements) {
    const auto all = element.waits_for;
    std::erase_if(element.waits_for, [&](std::size_t one) {
      return std::any_of(all.begin(), all.end(),
                         [&](std::size_t other) { return other != one && waits_for(elements, other, one); });
    });
  }
}

}  // namespace

Packing packing_from(const std::string& text) {
  Packing packing;
  packing.by_stage = text == "stage";
  if (packing.by_stage || text == "sequence") return packing;
  constexpr std::string_view kChunk = "chunk:";
  const char* end = text.data() + text.size();
  if (text.starts_with(kChunk)) {
    const auto [last, error] = std::from_chars(text.data() + kChunk.size(), end, packing.instances);
    if (error == std::errc{} && last == end && packing.instances > 0) return packing;
  }
  throw contract::UsageError("--pack: expected sequence, stage or chunk:N with N of at least 1, found \"" +
                             text + '"');
}

std::vector<Element> pack(const std::vector<Work>& works, const std::vector<Instance>& instances,
                          const Submittable& submittable, const Packing& packing, const Profile& profile) {
  const auto element_of = assign(works, submittable.open, packing);
  std::vector<Element> elements;
  std::vector<std::set<std::size_t>> before;
  std::vector<std::set<std::string>> jobs;
  for (const auto& [w, e] : element_of) {
    elements.resize(std::max(elements.size(), e + 1));
    before.resize(elements.size());
    jobs.resize(elements.size());
    const PlannedStage& stage = stage_of(works[w], instances);
    const auto tried = submittable.attempts.find(w);
    const Request request =
        request_of(stage, profile, tried == submittable.attempts.end() ? 0 : tried->second);
    if (elements[e].works.empty())
      elements[e].request = request;
    else
      add(elements[e].request, request, stage.name);
    elements[e].works.push_back(w);
    for (const std::size_t read : works[w].reads) {
      if (const auto other = element_of.find(read); other != element_of.end() && other->second != e)
        before[e].insert(other->second);
      if (const auto job = submittable.jobs.find(read); job != submittable.jobs.end())
        jobs[e].insert(job->second);
    }
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    elements[e].waits_for.assign(before[e].begin(), before[e].end());
    elements[e].waits_for_jobs.assign(jobs[e].begin(), jobs[e].end());
  }
  set_layers(elements);
  drop_implied(elements);
  return elements;
}

}  // namespace sediment::runner::slurm
