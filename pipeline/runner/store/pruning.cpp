#include "pipeline/runner/store/pruning.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <tuple>

#include "pipeline/contract/digest.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

/// What nothing refers to is left alone for this long: a runner may be about to write its receipt.
constexpr auto kUnfinished = std::chrono::hours(1);

struct Candidate {
  Pruned result;  ///< its stage, key, size
  std::string object;
  fs::path file;
  fs::file_time_type made;
};

std::vector<Candidate> all_receipts(const Store& store) {
  std::vector<Candidate> all;
  for (const fs::path& file : store.receipt_files())
    if (const auto receipt = store.receipt_in(file))
      all.push_back({{receipt->parts.at("stage"), receipt->key, receipt->started, receipt->bytes},
                     object_name(receipt->object),
                     file,
                     fs::last_write_time(file)});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::tie(a.made, a.result.key) < std::tie(b.made, b.result.key);
  });
  return all;
}

/// "ab/cdef" of the folder of an object.
std::string name_of_object(const fs::path& folder) {
  return (folder.parent_path().filename() / folder.filename()).string();
}

/// Names of the objects that links in the known folders of results lead to.
std::set<std::string> linked_objects(const Store& store) {
  std::set<std::string> objects;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(store.root() / "workspaces", ignored)) {
    std::ifstream stream(entry.path());
    std::string folder;
    std::getline(stream, folder);
    auto files = fs::recursive_directory_iterator(folder, ignored);
    for (; files != fs::recursive_directory_iterator(); files.increment(ignored)) {
      if (files->path() == store.root()) files.disable_recursion_pending();
      if (!files->is_symlink(ignored)) continue;
      objects.insert(name_of_object(fs::weakly_canonical(files->path(), ignored)));
    }
  }
  return objects;
}

/// Objects that no receipt names: what a runner that died between result and receipt has left.
void remove_unreferenced(const Store& store, const std::set<std::string>& referenced) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  for (const fs::path& object : store.object_folders()) {
    const auto stat = stat_of(object);
    const bool is_old = stat && std::chrono::nanoseconds(stat->changed_ns) + kUnfinished < now;
    if (is_old && !referenced.contains(name_of_object(object))) fs::remove_all(object);
  }
}

/// Folders and files that were last written before that time.
void remove_older(const fs::path& folder, fs::file_time_type time) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.last_write_time(ignored) < time) fs::remove_all(entry.path(), ignored);
}

}  // namespace

std::vector<Pruned> prune(Store& store, const PruningRules& rules) {
  const std::vector<Candidate> all = all_receipts(store);
  const std::set<std::string> linked = linked_objects(store);
  std::map<std::string, int> users;
  std::uint64_t total = 0;
  for (const Candidate& one : all)
    if (users[one.object]++ == 0) total += one.result.bytes;

  std::vector<Pruned> pruned;
  const auto now = fs::file_time_type::clock::now();
  for (const Candidate& one : all) {
    const std::string& key = one.result.key;
    if (linked.contains(one.object) || fs::exists(store.root() / "pins" / bare(key))) continue;
    if (rules.keep && rules.keep->contains(key)) continue;
    if (rules.older_than_s && one.made + std::chrono::seconds(*rules.older_than_s) > now) continue;
    if (rules.max_bytes && total <= *rules.max_bytes) break;
    const auto lock = store.try_lock(key);
    if (!lock) continue;
    const bool frees = --users[one.object] == 0;
    if (frees) total -= one.result.bytes;
    pruned.push_back(one.result);
    if (!frees) pruned.back().bytes = 0;
    if (rules.dry_run) continue;
    fs::remove(one.file);
    if (frees) fs::remove_all(store.root() / "objects" / one.object);
    store.memory().forget(StatMemory::Use::receipt, key);
  }
  if (rules.dry_run) return pruned;
  if (rules.older_than_s)
    for (const char* part : {"runs", "quarantine"})
      remove_older(store.root() / part, now - std::chrono::seconds(*rules.older_than_s));
  std::set<std::string> referenced;
  for (const auto& [object, count] : users)
    if (count > 0) referenced.insert(object);
  remove_unreferenced(store, referenced);
  store.memory().save();
  return pruned;
}

void set_pinned(const Store& store, const std::string& key, bool pinned) {
  const fs::path pin = store.root() / "pins" / bare(key);
  if (!pinned) {
    fs::remove(pin);
    return;
  }
  fs::create_directories(pin.parent_path());
  std::ofstream stream(pin);
  if (!stream) throw std::runtime_error("cannot write " + pin.string());
}

void remember_workspace(const Store& store, const fs::path& folder) {
  const fs::path file = store.root() / "workspaces" / bare(contract::digest_bytes(folder.native()));
  if (fs::exists(file)) return;
  fs::create_directories(file.parent_path());
  std::ofstream(file) << folder.native() << '\n';
}

}  // namespace sediment::runner
