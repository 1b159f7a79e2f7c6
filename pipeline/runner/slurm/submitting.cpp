#include "pipeline/runner/slurm/submitting.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <ctime>
#include <set>
#include <stdexcept>

#include "pipeline/runner/slurm/batch_script.hpp"

namespace sediment::runner::slurm {
namespace {

namespace fs = std::filesystem;

/// Behind the newest of the store, whatever the clocks of the machines say.
fs::path fresh_folder(const Store& store) {
  const auto earlier = submissions_in(store);
  const std::size_t number = earlier.empty() ? 1 : std::stoul(earlier.back().folder.filename().string()) + 1;
  const std::string time = fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(std::time(nullptr)));
  fs::path folder = store.root() / "slurm" / fmt::format("{:06}-{}", number, time);
  for (const char* part : {"logs", "ended"}) fs::create_directories(folder / part);
  return folder;
}

Submission submission_of(const fs::path& folder, const std::string& out, const std::vector<Array>& arrays,
                         const std::vector<Element>& elements, const std::vector<Work>& works,
                         const std::vector<Progress>& progress) {
  Submission submission{folder, out, {}, {}, {}, false};
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    submission.names.push_back(fmt::format("sediment-{}-{}", folder.filename().string(), a));
    for (const auto& [index, e] : arrays[a].tasks) {
      Submission::Task task{a, index, {}, {}};
      for (const std::size_t w : elements[e].works) {
        task.works.push_back(works[w].id);
        task.attempts.push_back(progress[w].attempts);
      }
      submission.tasks.push_back(std::move(task));
    }
  }
  return submission;
}

/// The limit of one array, so that those of its layer keep to it together.
int cap_of(const Setup& setup, const std::vector<Array>& arrays, std::size_t layer) {
  const int limit = setup.in_flight > 0 ? setup.in_flight : setup.profile.in_flight;
  if (limit == 0) return 0;
  const auto together =
      std::count_if(arrays.begin(), arrays.end(), [&](const Array& array) { return array.layer == layer; });
  return std::max(1, limit / static_cast<int>(together));
}

void count(std::vector<SubmittedLayer>& layers, const Array& array, const std::string& job,
           const std::vector<Element>& elements, const std::vector<Work>& works,
           const std::vector<Instance>& instances) {
  layers.resize(std::max(layers.size(), array.layer + 1));
  SubmittedLayer& layer = layers[array.layer];
  layer.jobs.push_back(job);
  layer.tasks += array.tasks.size();
  for (const auto& [index, e] : array.tasks)
    for (const std::size_t w : elements[e].works) {
      ++layer.works;
      const std::string& stage = stage_of(works[w], instances).name;
      if (std::find(layer.stages.begin(), layer.stages.end(), stage) == layer.stages.end())
        layer.stages.push_back(stage);
    }
}

}  // namespace

std::vector<SubmittedLayer> submit(const std::vector<Work>& works, const std::vector<Instance>& instances,
                                   const std::vector<Progress>& progress, const std::vector<bool>& open,
                                   const Setup& setup, const Store& store, const std::string& out) {
  Submittable submittable{open, {}, {}};
  for (std::size_t w = 0; w < works.size(); ++w) {
    if (progress[w].in_flight() && !open[w]) submittable.jobs[w] = progress[w].job;
    submittable.attempts[w] = progress[w].attempts;
  }
  const std::vector<Element> elements = pack(works, instances, submittable, setup.packing, setup.profile);
  const std::vector<Array> arrays = arrays_of(elements, most_array_tasks());

  const fs::path folder = fresh_folder(store);
  write_orders(folder, arrays, elements, works, instances, setup.manner, setup.profile);
  const Submission submission = submission_of(folder, out, arrays, elements, works, progress);
  write(submission);

  SubmittedArrays submitted{{}, std::vector<std::pair<std::size_t, std::size_t>>(elements.size())};
  std::vector<SubmittedLayer> layers;
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    const BatchScript script{folder, a, submission.names[a], cap_of(setup, arrays, arrays[a].layer),
                             dependency_of(arrays[a], submitted)};
    const fs::path file = folder / fmt::format("array-{}.sh", a);
    write_whole(file, text_of(script, arrays[a]));
    try {
      submitted.jobs.push_back(slurm::submit(file));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}; {} of {} array jobs are submitted, run again for the rest",
                                           error.what(), a, arrays.size()));
    }
    note_job(submission, a, submitted.jobs.back());
    for (const auto& [index, e] : arrays[a].tasks) submitted.element_at[e] = {a, index};
    count(layers, arrays[a], submitted.jobs.back(), elements, works, instances);
  }
  return layers;
}

std::vector<bool> all_missing(const std::vector<Work>& works, const std::vector<Instance>& instances,
                              const std::vector<Progress>& progress) {
  std::vector<bool> open(works.size());
  for (std::size_t w = 0; w < works.size(); ++w) {
    open[w] = !progress[w].is_there() && !progress[w].in_flight();
    if (open[w] && !works[w].selected)
      throw std::runtime_error(label_of(works[w], instances) +
                               " is needed, is not in the store and was not selected to run");
  }
  return open;
}

std::vector<bool> to_retry(const std::vector<Work>& works, const std::vector<Instance>& instances,
                           const std::vector<Progress>& progress) {
  constexpr int kLostAgain = 3;
  std::vector<bool> open(works.size());
  for (std::size_t w = 0; w < works.size(); ++w) {
    const Progress& one = progress[w];
    const int retries = stage_of(works[w], instances).resources.retries;
    const bool wanted = one.state == State::blocked || one.state == State::open ||
                        (one.state == State::lost && one.attempts <= std::max(retries, kLostAgain)) ||
                        (one.state == State::failed && one.attempts <= retries);
    open[w] = wanted && works[w].selected &&
              std::all_of(works[w].reads.begin(), works[w].reads.end(), [&](std::size_t read) {
                return open[read] || progress[read].is_there() || progress[read].in_flight();
              });
  }
  return open;
}

KeyLock lock_of_submissions(const Store& store) {
  while (true) {
    if (auto lock = store.try_lock("slurm-submissions")) return std::move(*lock);
    constexpr timespec kRetry{0, 50'000'000};
    nanosleep(&kRetry, nullptr);
  }
}

void remove_settled(const std::vector<Work>& works, const std::vector<Progress>& progress,
                    const Observed& observed, const std::string& out) {
  std::set<std::string> missing, superseded;
  for (std::size_t w = 0; w < works.size(); ++w)
    if (!progress[w].is_there()) missing.insert(works[w].id);
  for (auto one = observed.submissions.rbegin(); one != observed.submissions.rend(); ++one) {
    bool settled = one->out == out;
    for (const Submission::Task& task : one->tasks) {
      const auto array = observed.queue.find(one->names[task.array]);
      if (array != observed.queue.end() && array->second.contains(task.index))
        settled = settled && !array->second.at(task.index).is_alive();
      for (const std::string& work : task.works)
        settled = settled && (!missing.contains(work) || superseded.contains(work));
    }
    for (const Submission::Task& task : one->tasks) superseded.insert(task.works.begin(), task.works.end());
    std::error_code ignored;
    if (settled) fs::remove_all(one->folder, ignored);
  }
}

}  // namespace sediment::runner::slurm
