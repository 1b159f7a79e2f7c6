#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/runner/store/key_lock.hpp"

namespace sediment::runner {

/// The private folders in which stages run: STORE/attempts/RUNNER.KEY. A runner holds a lock for as long as
/// it lives, so that the folders of one that died are known.
///
/// A folder that a stage left empty is used again, with its log: ext4 looks at every inode that was freed in
/// the last minutes before it makes a new one, and after a few thousand folders that costs more than the
/// stages.
class AttemptFolders {
 public:
  explicit AttemptFolders(std::filesystem::path store);

  /// A folder with nothing in it but, perhaps, an old log. All processes of the stage before must have ended.
  std::filesystem::path take(const std::string& key);
  void give_back(const std::filesystem::path& folder);
  /// The folder of an attempt that runs at this moment, of any runner.
  std::optional<std::filesystem::path> find(const std::string& key) const;
  /// A file in which a receipt is written before it is published.
  std::filesystem::path draft_of_receipt() const { return root_ / (runner_ + ".receipt"); }
  /// Removes the folders of runners that died, and our own that nobody uses.
  void tidy();

 private:
  std::filesystem::path root_, locks_;
  std::string runner_;  ///< random: a number of a process comes again
  std::optional<KeyLock> alive_;
  std::vector<std::filesystem::path> spare_;
};

}  // namespace sediment::runner
