#include "pipeline/runner/slurm/submission.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace sediment::runner::slurm {
namespace {

namespace fs = std::filesystem;
using contract::Json;

constexpr const char* kFormat = "sediment-slurm 1";

fs::path endings_file(const fs::path& folder, std::size_t array, std::size_t index) {
  return folder / "ended" / (std::to_string(array) + '.' + std::to_string(index) + ".json");
}

void append_line(const fs::path& file, const std::string& line) {
  std::ofstream stream(file, std::ios::app);
  stream << line << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno));
}

Submission read_submission(const fs::path& folder) {
  std::ifstream stream(folder / "submission.json", std::ios::binary);
  const Json json = Json::parse(stream);
  if (json.at("format") != kFormat) throw std::runtime_error("unknown format " + json.at("format").dump());
  Submission submission{folder, json.at("out"), json.at("names"), {}, {}, fs::exists(folder / "cancelled")};
  for (const Json& one : json.at("tasks"))
    submission.tasks.push_back({one.at(0), one.at(1), one.at(2), one.at(3)});
  std::ifstream jobs(folder / "jobs");
  std::size_t array = 0;
  for (std::string job; jobs >> array >> job;) submission.jobs[array] = job;
  return submission;
}

}  // namespace

void write_whole(const fs::path& file, const std::string& text) {
  const fs::path fresh = file.string() + ".partial." + std::to_string(getpid());
  std::ofstream stream(fresh, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + fresh.string() + ": " + std::strerror(errno));
  fs::rename(fresh, file);
}

void write(const Submission& submission) {
  nlohmann::ordered_json json = {{"format", kFormat}, {"out", submission.out}, {"names", submission.names}};
  json["tasks"] = nlohmann::ordered_json::array();
  for (const Submission::Task& task : submission.tasks)
    json["tasks"].push_back({task.array, task.index, task.works, task.attempts});
  write_whole(submission.folder / "submission.json", json.dump() + '\n');
}

void note_job(const Submission& submission, std::size_t array, const std::string& job) {
  append_line(submission.folder / "jobs", std::to_string(array) + ' ' + job);
}

void note_cancelled(const Submission& submission) {
  append_line(submission.folder / "cancelled", "");
}

std::vector<Submission> submissions_in(const Store& store) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(store.root() / "slurm", ignored))
    if (fs::exists(entry.path() / "submission.json")) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  std::vector<Submission> all;
  for (const fs::path& folder : folders) try {
      all.push_back(read_submission(folder));
    } catch (const std::exception& error) {
      throw std::runtime_error((folder / "submission.json").string() + ": " + error.what());
    }
  return all;
}

WorkEndings endings_of(const Submission& submission, const Submission::Task& task) try {
  WorkEndings endings;
  std::ifstream stream(endings_file(submission.folder, task.array, task.index), std::ios::binary);
  if (!stream) return endings;
  const Json json = Json::parse(stream);
  for (const auto& [work, one] : json.items())
    endings[work] = {one.at("state"), one.at("why"), one.at("log")};
  return endings;
} catch (const Json::exception&) {
  return {};
}

void write_endings(const fs::path& folder, std::size_t array, std::size_t index, const WorkEndings& endings) {
  Json json = Json::object();
  for (const auto& [work, ending] : endings)
    json[work] = {{"state", ending.state}, {"why", ending.why}, {"log", ending.log}};
  write_whole(endings_file(folder, array, index),
              json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace sediment::runner::slurm
