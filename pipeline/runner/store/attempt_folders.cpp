#include "pipeline/runner/store/attempt_folders.hpp"

#include <fmt/format.h>

#include <random>

#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

std::string random_name() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

bool holds_only_a_log(const fs::path& folder) {
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(folder, unknown))
    if (entry.path().filename() != "log") return false;
  return !unknown;
}

}  // namespace

AttemptFolders::AttemptFolders(fs::path store)
    : root_(store / "attempts"), locks_(lock_file(store)), runner_(random_name()) {}

fs::path AttemptFolders::take(const std::string& key) {
  if (!alive_) alive_ = KeyLock::try_acquire(locks_, runner_);
  const fs::path folder = root_ / (runner_ + '.' + bare(key));
  fs::remove_all(folder);
  while (!spare_.empty()) {
    const fs::path spare = std::move(spare_.back());
    spare_.pop_back();
    if (rename(spare.c_str(), folder.c_str()) == 0) return folder;
  }
  fs::create_directory(folder);
  return folder;
}

void AttemptFolders::give_back(const fs::path& folder) {
  std::error_code ignored;
  if (holds_only_a_log(folder))
    spare_.push_back(folder);
  else
    fs::remove_all(folder, ignored);
}

std::optional<fs::path> AttemptFolders::find(const std::string& key) const {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(root_, none))
    if (entry.path().extension() == '.' + bare(key)) return entry.path();
  return std::nullopt;
}

void AttemptFolders::tidy() try {
  std::error_code ignored;
  for (const fs::path& spare : spare_) fs::remove_all(spare, ignored);
  spare_.clear();
  for (const auto& entry : fs::directory_iterator(root_, ignored)) {
    const std::string name = entry.path().filename(), runner = name.substr(0, name.find('.'));
    const auto dead = KeyLock::try_acquire(locks_, runner);
    if (dead) fs::remove_all(entry.path(), ignored);
  }
} catch (const std::runtime_error&) {
  // A store that cannot be written keeps its leftovers; what has to be written will say so.
}

}  // namespace sediment::runner
