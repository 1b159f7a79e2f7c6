#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pipeline/contract/manifest.hpp"
#include "pipeline/runner/store/stat_memory.hpp"

namespace sediment::runner {

/// Digests all files of a dataset into its manifest.json and makes them read-only. From then on the runner
/// looks at no file of it but the manifest. Throws contract::UsageError if the folder is the result of a
/// stage.
contract::Manifest seal_folder(const std::filesystem::path& folder);

/// Removes the manifest and lets the files be written again.
void unseal_folder(const std::filesystem::path& folder);

/// A dataset that was sealed.
class SealedFolder {
 public:
  /// Nothing if the folder is not sealed.
  static std::optional<SealedFolder> open(const std::filesystem::path& folder, StatMemory& memory);

  /// Content id of the folder.
  const std::string& id() const { return id_; }
  /// Something derived from the manifest alone, remembered under a name until the manifest changes.
  std::string derived(
      const std::string& name,
      const std::function<std::string(const std::map<std::string, std::string>& digests)>& derive);

 private:
  SealedFolder(std::filesystem::path folder, FileStat stat, std::string id, StatMemory& memory)
      : folder_(std::move(folder)), stat_(stat), id_(std::move(id)), memory_(memory) {}

  std::filesystem::path folder_;
  FileStat stat_;  ///< of the manifest
  std::string id_;
  StatMemory& memory_;
};

}  // namespace sediment::runner
