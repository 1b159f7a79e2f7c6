#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sediment::contract {

/// One file of a result.
struct FileEntry {
  std::string path;  ///< relative to the folder, '/' as separator
  std::uint64_t bytes = 0;
  std::string digest;
  friend bool operator==(const FileEntry&, const FileEntry&) = default;
};

/// What a result folder holds: every file but manifest.json itself, sorted by path.
struct Manifest {
  std::string stage;
  std::vector<FileEntry> files;

  /// Content id of the folder: digest over size, digest and path of each file. The stage's name is not part.
  std::string id() const;
  std::uint64_t bytes() const;
};

inline constexpr const char* kManifestName = "manifest.json";

/// Digests every regular file under the folder (in parallel; the result does not depend on it). Symbolic
/// links are followed. Throws std::runtime_error naming a file that cannot be read.
Manifest manifest_of(const std::filesystem::path& folder, const std::string& stage);

/// Writes manifest.json into the folder.
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder);

/// Reads manifest.json of a folder. Throws std::runtime_error if it is missing, malformed or its own id does
/// not match its entries.
Manifest read_manifest(const std::filesystem::path& folder);

}  // namespace sediment::contract
