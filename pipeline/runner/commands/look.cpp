#include "pipeline/runner/commands/look.hpp"

namespace sediment::runner {
namespace {

std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}#~`!") == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + '\'';
}

}  // namespace

const StageRecord* Look::last_of(std::size_t idx) const {
  const auto found = last.find(stage(idx).name);
  return found == last.end() ? nullptr : &found->second;
}

Look look(const Arguments& arguments) {
  Look all{open_pipeline(arguments), {}, {}};
  all.tasks = plan(all.opened.instance, *all.opened.store, arguments.threads);
  all.last = Workspace(all.opened.instance.out).read_record();
  all.opened.store->memory().save();
  return all;
}

const char* name_of(PlannedTask::State state) {
  switch (state) {
    case PlannedTask::State::kept:
      return "kept";
    case PlannedTask::State::runs:
      return "runs";
    case PlannedTask::State::behind:
      return "may run";
    case PlannedTask::State::skipped:
      return "skipped";
  }
  return "";
}

std::string shell_text(const std::vector<std::string>& argv) {
  std::string text;
  for (const std::string& word : argv) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

}  // namespace sediment::runner
