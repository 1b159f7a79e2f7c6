#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/contract/manifest.hpp"
#include "pipeline/runner/store/attempt_folders.hpp"
#include "pipeline/runner/store/key_lock.hpp"
#include "pipeline/runner/store/receipt.hpp"
#include "pipeline/runner/store/stat_memory.hpp"

namespace sediment::runner {

/// What a result is known by when its receipt is valid and its files are there with the right sizes.
struct Hit {
  std::string object;
  std::uint64_t bytes = 0;
};

/// A folder by which files are looked up: a run with nothing to do spends half its time in walking down long
/// paths.
struct OpenFolder {
  int descriptor;

  /// Nothing if there is no such folder.
  static std::optional<OpenFolder> open(const std::filesystem::path& folder);
  explicit OpenFolder(int opened) : descriptor(opened) {}
  OpenFolder(OpenFolder&& other) noexcept : descriptor(std::exchange(other.descriptor, -1)) {}
  OpenFolder& operator=(OpenFolder&& other) noexcept {
    std::swap(descriptor, other.descriptor);
    return *this;
  }
  ~OpenFolder();
};

/// The folder of all results (pipeline/runner/README.md has its layout). Any number of runners may work on it
/// at the same time.
class Store {
 public:
  /// A store that is absent is empty. Throws contract::UsageError if the folder is no store or of an unknown
  /// version.
  explicit Store(const std::filesystem::path& root);
  /// Makes its folders, if they are absent: before anything is published. `durable`: from now on a result is
  /// on the disk (fsync) before its receipt is.
  void make(bool durable = false);

  const std::filesystem::path& root() const { return root_; }
  StatMemory& memory() { return memory_; }
  AttemptFolders& attempts() { return attempts_; }

  /// The result of a key, or nothing. A receipt or a result that is damaged is put aside and counts as
  /// absent.
  std::optional<Hit> find(const std::string& key);
  /// The receipt of a key, whether or not its result is still there.
  std::optional<Receipt> receipt(const std::string& key) const;
  /// The receipt in a file of the store; nothing if it is damaged or not where it belongs.
  std::optional<Receipt> receipt_in(const std::filesystem::path& file) const;
  std::vector<std::filesystem::path> receipt_files() const;
  std::vector<std::filesystem::path> object_folders() const;

  std::optional<KeyLock> try_lock(const std::string& key) const;
  bool is_locked(const std::string& key) const;
  /// Seals a result folder (read-only files) and moves it in. If the content is there already, that one
  /// stays.
  void publish_object(const std::filesystem::path& folder, const contract::Manifest& manifest) const;
  /// Writes the receipt: from now on the key is a hit.
  void publish_receipt(const Receipt& receipt);

  std::filesystem::path object_path(const std::string& id) const;
  std::filesystem::path receipt_path(const std::string& key) const;
  /// Moves something damaged to quarantine/.
  void put_aside(const std::filesystem::path& path) const;

 private:
  std::optional<FileStat> stat_in(const std::string& name) const;
  bool is_whole(const std::string& summary) const;

  std::filesystem::path root_;
  StatMemory memory_;
  AttemptFolders attempts_;
  std::optional<OpenFolder> folder_;  ///< root_, once it is there
  bool durable_ = false;
};

}  // namespace sediment::runner
