#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/store/stat_memory.hpp"

namespace sediment::runner {

/// Digests of files: each distinct file is stat'ed once, and read only if the memory does not know it.
class FileDigests {
 public:
  /// `rehash`: read every file, whatever the memory knows.
  FileDigests(StatMemory& memory, bool rehash) : memory_(memory), rehash_(rehash) {}

  struct Known {
    std::string digest;  ///< "missing" if there is no such file
    std::uint64_t bytes = 0;
  };

  /// Digests all these files, in parallel where they must be read. Throws std::runtime_error naming a file
  /// that cannot be read.
  void add(const std::vector<std::string>& files);
  /// Of a file that was added.
  const Known& at(const std::string& file) const { return known_.at(file); }
  StatMemory& memory() { return memory_; }
  /// Adds one file.
  const Known& of(const std::filesystem::path& file);

 private:
  StatMemory& memory_;
  bool rehash_;
  std::unordered_map<std::string, Known> known_;
};

inline constexpr const char* kMissing = "missing";

}  // namespace sediment::runner
