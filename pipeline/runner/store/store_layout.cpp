#include "pipeline/runner/store/store_layout.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "pipeline/contract/errors.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
constexpr const char* kVersion = "sediment-store 1 xxh3-128";

void write_version(const fs::path& file) {
  const fs::path fresh = file.string() + '.' + std::to_string(getpid());
  std::ofstream stream(fresh, std::ios::binary);
  stream << kVersion << '\n';
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + fresh.string() + ": " + std::strerror(errno));
  fs::rename(fresh, file);
}

}  // namespace

fs::path checked_store(const fs::path& given) {
  fs::path root = fs::absolute(given).lexically_normal();
  if (!root.has_filename()) root = root.parent_path();
  std::string version;
  if (std::ifstream stream(root / "VERSION"); stream) std::getline(stream, version);
  if (!version.empty() && version != kVersion)
    throw contract::UsageError(root.string() + " is a store of another version: expected \"" + kVersion +
                               "\", found \"" + version + '"');
  if (version.empty() && fs::exists(root) && !fs::is_empty(root) && !fs::exists(root / "objects"))
    throw contract::UsageError(root.string() + " is neither empty nor a store (it has no VERSION)");
  return root;
}

void make_store(const fs::path& root) {
  for (const char* part : {"objects", "receipts", "attempts", "locks", "index", "runs"})
    fs::create_directories(root / part);
  if (!fs::exists(root / "VERSION")) write_version(root / "VERSION");
}

fs::path lock_file(const fs::path& root) {
  return root / "locks" / "keys";
}

fs::path index_file(const fs::path& root) {
  return root / "index" / (host_name() + ".stat");
}

std::string bare(const std::string& id) {
  return id.substr(id.find(':') + 1);
}

std::string object_name(const std::string& id) {
  const std::string name = bare(id);
  return name.substr(0, 2) + '/' + name.substr(2);
}

std::vector<fs::path> sharded_entries(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code ignored;
  for (const auto& shard : fs::directory_iterator(folder, ignored))
    for (const auto& entry : fs::directory_iterator(shard.path(), ignored)) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace sediment::runner
