#include "pipeline/runner/store/file_digests.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "pipeline/contract/digest.hpp"
#include "pipeline/contract/progress.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

/// Less than this is read without a word: nobody waits for it.
constexpr std::uint64_t kQuiet_bytes = 500'000'000;

struct Unread {
  const std::string* path;
  FileStat stat;
  FileDigests::Known* known;
};

/// Digests every file with as many threads as there are cores; the first error wins.
void read_files(const std::vector<Unread>& files) {
  std::uint64_t bytes = 0;
  for (const Unread& file : files) bytes += file.stat.bytes;
  std::optional<contract::Progress> progress;
  if (bytes > kQuiet_bytes) progress.emplace("reading sources", files.size(), "files");
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < files.size(); i = next++) try {
        files[i].known->digest = contract::digest_file(*files[i].path);
        if (progress) progress->advance();
      } catch (...) {
        const std::lock_guard lock(mutex);
        error = std::current_exception();
      }
  };
  std::vector<std::jthread> helpers;
  const std::size_t wanted = bytes < 1'000'000 ? 1 : std::thread::hardware_concurrency();
  for (std::size_t i = 1; i < std::min(wanted, files.size()); ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  if (error) std::rethrow_exception(error);
}

}  // namespace

void FileDigests::add(const std::vector<std::string>& files) {
  std::vector<Unread> unread;
  known_.reserve(known_.size() + files.size());
  for (const std::string& file : files) {
    const auto [place, fresh] = known_.try_emplace(file);
    if (!fresh) continue;
    const auto stat = stat_of(file.c_str());
    Known& known = place->second;
    known.digest = kMissing;
    if (!stat) continue;
    known.bytes = stat->bytes;
    const auto remembered = memory_.recall(StatMemory::Use::digest, place->first, *stat);
    if (remembered && !rehash_)
      known.digest = *remembered;
    else
      unread.push_back({&place->first, *stat, &known});
  }
  if (unread.empty()) return;
  read_files(unread);
  for (const Unread& file : unread)
    memory_.remember(StatMemory::Use::digest, *file.path, file.stat, file.known->digest, true);
}

const FileDigests::Known& FileDigests::of(const fs::path& file) {
  add({file.native()});
  return at(file.native());
}

}  // namespace sediment::runner
