#include "pipeline/runner/slurm/controller.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/execution/process.hpp"

namespace sediment::runner::slurm {
namespace {

namespace fs = std::filesystem;

/// A busy controller lets sbatch try again for a while.
constexpr int kLimit_s = 120;
constexpr std::size_t kNamesPerCall = 500;

fs::path found_program(const std::string& name) {
  std::istringstream folders(environment("PATH").value_or("/usr/local/bin:/usr/bin:/bin"));
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::absolute(folder) / name; access(file.c_str(), X_OK) == 0) return file;
  throw contract::UsageError("--backend slurm: there is no \"" + name + "\" in PATH");
}

/// With the environment of the user, which says where Slurm's configuration is and what jobs inherit.
std::string answer_of(std::vector<std::string> argv) {
  argv[0] = found_program(argv[0]).string();
  std::vector<std::string> inherited;
  for (char** one = environ; *one != nullptr; ++one) inherited.push_back(*one);
  std::string text = output_of(argv, kLimit_s, inherited);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// The number behind NAME in a text like "NAME = 1001" or "a=b,NAME=1001,c"; `missing` if there is none.
std::size_t number_behind(const std::string& text, const std::string& name, std::size_t missing) {
  std::size_t at = text.find(name);
  if (at == std::string::npos) return missing;
  at = text.find_first_not_of(" =", at + name.size());
  return at != std::string::npos && std::isdigit(text[at]) ? std::stoul(text.substr(at)) : missing;
}

/// Splits "12_3|name|PENDING|Resources". A reason may contain anything.
std::array<std::string, 4> fields_of(const std::string& line) {
  std::array<std::string, 4> fields;
  std::istringstream stream(line);
  for (std::size_t i = 0; i < 3; ++i) std::getline(stream, fields[i], '|');
  std::getline(stream, fields[3]);
  return fields;
}

}  // namespace

bool QueuedTask::is_alive() const {
  static const std::vector<std::string> kEnded{"BOOT_FAIL", "CANCELLED",    "COMPLETED", "DEADLINE",
                                               "FAILED",    "NODE_FAIL",    "PREEMPTED", "REVOKED",
                                               "TIMEOUT",   "OUT_OF_MEMORY"};
  return std::find(kEnded.begin(), kEnded.end(), state) == kEnded.end();
}

Queue queue_of(const std::vector<std::string>& names) {
  Queue queue;
  for (std::size_t first = 0; first < names.size(); first += kNamesPerCall) {
    std::string list;
    for (std::size_t i = first; i < std::min(names.size(), first + kNamesPerCall); ++i)
      list += (list.empty() ? "" : ",") + names[i];
    std::istringstream lines(answer_of(
        {"squeue", "--noheader", "--array", "--states=all", "--name=" + list, "--format=%i|%j|%T|%r"}));
    for (std::string line; std::getline(lines, line);) {
      const auto [job, name, state, reason] = fields_of(line);
      const std::size_t index = number_behind(job, "_", std::string::npos);
      if (index != std::string::npos) queue[name][index] = {job, state, reason};
    }
  }
  return queue;
}

std::string submit(const fs::path& script) {
  const std::string said = answer_of({"sbatch", "--parsable", script.string()});
  const std::string job = said.substr(0, said.find(';'));  // behind it the cluster
  if (job.empty() || !std::all_of(job.begin(), job.end(), [](unsigned char c) { return std::isdigit(c); }))
    throw std::runtime_error("sbatch named no job but said \"" + said + '"');
  return job;
}

void cancel(const std::vector<std::string>& jobs) {
  if (jobs.empty()) return;
  std::vector<std::string> argv{"scancel"};
  argv.insert(argv.end(), jobs.begin(), jobs.end());
  answer_of(argv);
}

std::size_t most_array_tasks() {
  constexpr std::size_t kDefault = 1001;
  const std::string config = answer_of({"scontrol", "show", "config"});
  const std::size_t size = number_behind(config, "MaxArraySize", kDefault);
  if (size < 2)
    throw contract::UsageError("this Slurm takes no array jobs (MaxArraySize " + std::to_string(size) + ')');
  return std::max<std::size_t>(1, std::min(size, number_behind(config, "max_array_tasks", size)));
}

void check_commands() {
  for (const char* name : {"sbatch", "squeue", "scancel", "scontrol"}) found_program(name);
}

}  // namespace sediment::runner::slurm
