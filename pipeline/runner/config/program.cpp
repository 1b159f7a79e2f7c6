#include "pipeline/runner/config/program.hpp"

#include <unistd.h>

#include <vector>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/violations.hpp"
#include "pipeline/runner/execution/process.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::UsageError;

constexpr int kDescribeLimit_s = 30;

std::vector<std::string> executables_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_regular_file() && access(entry.path().c_str(), X_OK) == 0)
      names.push_back(entry.path().filename());
  return names;
}

}  // namespace

std::shared_ptr<const Program> Programs::find(const std::string& stage) {
  auto& program = found_[stage];
  if (!program) program = std::make_shared<const Program>(load(stage));
  return program;
}

Program Programs::load(const std::string& stage) {
  Program program;
  program.path = folder_ / stage;
  const auto stat = stat_of(program.path);
  if (stage.empty() || stage.find('/') != std::string::npos || !stat || !fs::is_regular_file(program.path))
    throw UsageError("unknown stage \"" + stage + "\": no such program in " + folder_.string() +
                     did_you_mean(stage, executables_in(folder_)));
  program.digest = digests_.of(program.path).digest;
  const std::string path = program.path.string();
  std::string text(memory_.recall(StatMemory::Use::description, path, *stat).value_or(""));
  const bool asked = text.empty();
  try {
    if (asked) text = output_of({path, "--describe"}, kDescribeLimit_s);
    program.description = contract::description_from(contract::Json::parse(text));
  } catch (const std::exception& error) {
    throw UsageError("stage \"" + stage + "\": " + path + " --describe: " + error.what());
  }
  if (program.description.stage != stage)
    throw UsageError("stage \"" + stage + "\": " + path + " says it is \"" + program.description.stage + '"');
  if (asked) memory_.remember(StatMemory::Use::description, path, *stat, text, true);
  return program;
}

fs::path own_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace sediment::runner
