#include "pipeline/runner/store/store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/store/durable.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

/// A receipt in the memory: object, bytes, then a line "size path" per file.
std::string summary_of(const Receipt& receipt) {
  std::string text = receipt.object + '\n' + std::to_string(receipt.bytes) + '\n';
  for (const auto& [path, bytes] : receipt.files) text += std::to_string(bytes) + ' ' + path + '\n';
  return text;
}

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

std::uint64_t number_of(std::string_view text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Moves into a folder that may be missing. `durable`: the new name is on the disk when it returns.
bool rename_into(const fs::path& from, const fs::path& to, bool durable) {
  bool done = rename(from.c_str(), to.c_str()) == 0;
  if (!done && errno != ENOENT) return false;
  if (!done) {
    fs::create_directories(to.parent_path());
    if (durable) sync_path(to.parent_path().parent_path());
    done = rename(from.c_str(), to.c_str()) == 0;
  }
  if (done && durable) sync_path(to.parent_path());
  return done;
}

}  // namespace

std::optional<OpenFolder> OpenFolder::open(const fs::path& folder) {
  OpenFolder opened(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (opened.descriptor < 0) return std::nullopt;
  return opened;
}

OpenFolder::~OpenFolder() {
  if (descriptor >= 0) close(descriptor);
}

Store::Store(const fs::path& root)
    : root_(checked_store(root)),
      memory_(index_file(root_)),
      attempts_(root_),
      folder_(OpenFolder::open(root_)) {}

void Store::make(bool durable) {
  make_store(root_);
  if (!folder_) folder_ = OpenFolder::open(root_);
  durable_ = durable;
}

fs::path Store::object_path(const std::string& id) const {
  return root_ / "objects" / object_name(id);
}
fs::path Store::receipt_path(const std::string& key) const {
  return root_ / "receipts" / (object_name(key) + ".json");
}

std::optional<FileStat> Store::stat_in(const std::string& name) const {
  struct stat raw {};
  if (folder_ && fstatat(folder_->descriptor, name.c_str(), &raw, 0) == 0) return file_stat(raw);
  return std::nullopt;
}

std::optional<Hit> Store::find(const std::string& key) {
  const auto stat = stat_in("receipts/" + object_name(key) + ".json");
  if (!stat) return std::nullopt;
  std::string summary(memory_.recall(StatMemory::Use::receipt, key, *stat).value_or(""));
  if (summary.empty()) {
    const auto read = receipt(key);
    if (!read) {
      put_aside(receipt_path(key));
      return std::nullopt;
    }
    summary = summary_of(*read);
    memory_.remember(StatMemory::Use::receipt, key, *stat, summary, false);
  }
  if (!is_whole(summary)) return std::nullopt;
  std::string_view rest = summary;
  Hit hit{std::string(next_line(rest)), 0};
  hit.bytes = number_of(next_line(rest));
  return hit;
}

bool Store::is_whole(const std::string& summary) const {
  std::string_view rest = summary;
  const std::string id(next_line(rest)), object = "objects/" + object_name(id) + '/';
  next_line(rest);
  while (!rest.empty()) {
    const std::string_view line = next_line(rest);
    const std::size_t space = line.find(' ');
    const auto stat = stat_in(object + std::string(line.substr(space + 1)));
    if (stat && stat->bytes == number_of(line)) continue;
    if (fs::exists(object_path(id))) put_aside(object_path(id));
    return false;
  }
  return true;
}

std::optional<Receipt> Store::receipt(const std::string& key) const {
  return receipt_in(receipt_path(key));
}

std::optional<Receipt> Store::receipt_in(const fs::path& file) const try {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  Receipt read = receipt_from(std::string(std::istreambuf_iterator<char>(stream), {}));
  if (receipt_path(read.key) != file) return std::nullopt;
  return read;
} catch (const std::exception&) {
  return std::nullopt;
}

std::vector<fs::path> Store::receipt_files() const {
  return sharded_entries(root_ / "receipts");
}
std::vector<fs::path> Store::object_folders() const {
  return sharded_entries(root_ / "objects");
}

void Store::put_aside(const fs::path& path) const {
  fs::create_directories(root_ / "quarantine");
  for (int count = 0;; ++count) {
    const fs::path place = root_ / "quarantine" / (path.filename().string() + '.' + std::to_string(count));
    if (fs::exists(place)) continue;
    if (rename(path.c_str(), place.c_str()) == 0 || errno == ENOENT) return;
    throw std::runtime_error("cannot put the damaged " + path.string() + " aside: " + std::strerror(errno));
  }
}

std::optional<KeyLock> Store::try_lock(const std::string& key) const {
  return KeyLock::try_acquire(lock_file(root_), key);
}

bool Store::is_locked(const std::string& key) const {
  return KeyLock::is_held(lock_file(root_), key);
}

void Store::publish_object(const fs::path& folder, const contract::Manifest& manifest) const {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) chmod(entry.path().c_str(), 0444);
  if (durable_) sync_tree(folder);
  const fs::path place = object_path(manifest.id());
  if (rename_into(folder, place, durable_)) return;
  if (errno != ENOTEMPTY && errno != EEXIST)
    throw std::runtime_error("cannot publish " + place.string() + ": " + std::strerror(errno));
  const bool same = std::all_of(manifest.files.begin(), manifest.files.end(), [&](const auto& file) {
    std::error_code error;
    return fs::file_size(place / file.path, error) == file.bytes;
  });
  if (same && fs::exists(place / contract::kManifestName)) return;
  put_aside(place);
  if (!rename_into(folder, place, durable_))
    throw std::runtime_error("cannot publish " + place.string() + ": " + std::strerror(errno));
}

void Store::publish_receipt(const Receipt& receipt) {
  const fs::path place = receipt_path(receipt.key);
  const fs::path fresh = attempts_.draft_of_receipt();
  std::ofstream stream(fresh, std::ios::binary);
  stream << text_of(receipt);
  stream.close();
  if (stream && durable_) sync_path(fresh);
  if (!stream || !rename_into(fresh, place, durable_)) {
    const int error = errno;
    fs::remove(fresh);
    throw std::runtime_error("cannot write the receipt " + place.string() + ": " + std::strerror(error));
  }
  if (const auto stat = stat_of(place))
    memory_.remember(StatMemory::Use::receipt, receipt.key, *stat, summary_of(receipt), false);
}

}  // namespace sediment::runner
