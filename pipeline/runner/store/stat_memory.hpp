#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace sediment::runner {

/// What identifies the state of a file without reading it.
struct FileStat {
  std::uint64_t device = 0, inode = 0, bytes = 0;
  std::int64_t modified_ns = 0, changed_ns = 0;
  friend bool operator==(const FileStat&, const FileStat&) = default;
};

/// Stat of a file (symbolic links followed); nothing if there is none.
std::optional<FileStat> stat_of(const char* file);
inline std::optional<FileStat> stat_of(const std::filesystem::path& file) {
  return stat_of(file.c_str());
}
FileStat file_stat(const struct stat& raw);

/// Remembers what was derived from the content of a file for as long as the stat of the file stays the same:
/// digests of sources and executables, descriptions of stages, what a receipt says. One per host and store,
/// kept in one file that may be lost or deleted at any time.
class StatMemory {
 public:
  /// What a value was derived from the file for: part of its name in the memory.
  enum class Use : char { digest = 'd', description = 's', receipt = 'r', seal = 'm' };

  /// An unreadable, corrupt or foreign file counts as empty.
  explicit StatMemory(std::filesystem::path file);

  std::optional<std::string_view> recall(Use use, std::string_view path, const FileStat& stat) const;
  /// `may_change`: the file can be written in place by others. It is then remembered only if it was last
  /// changed at least two seconds before now: a later write within the same tick of the clock would not be
  /// seen otherwise (git's "racy" rule).
  void remember(Use use, const std::string& path, const FileStat& stat, std::string value, bool may_change);

  void forget(Use use, std::string_view path);

  /// Writes the file anew if something was learnt. A memory that cannot be written is no error.
  void save();

 private:
  struct Entry {
    FileStat stat;
    std::string_view value;
  };

  std::filesystem::path file_;
  std::string loaded_;                                   ///< the file as read; names and values point into it
  std::deque<std::string> learnt_;                       ///< names and values that are not in it
  std::unordered_map<std::string_view, Entry> entries_;  ///< by use and path
  bool changed_ = false;
};

}  // namespace sediment::runner
