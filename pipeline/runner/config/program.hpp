#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "pipeline/contract/description.hpp"
#include "pipeline/runner/store/file_digests.hpp"

namespace sediment::runner {

/// The executable of a stage and what it promises.
struct Program {
  std::filesystem::path path;
  std::string digest;
  contract::Description description;
};

/// The executables of one folder, by the name of their stage.
class Programs {
 public:
  Programs(std::filesystem::path folder, StatMemory& memory, FileDigests& digests)
      : folder_(std::move(folder)), memory_(memory), digests_(digests) {}

  /// Asks the executable with --describe, unless the memory knows its answer. Throws contract::UsageError if
  /// there is no such executable (naming the nearest one) or it does not describe the stage of that name.
  std::shared_ptr<const Program> find(const std::string& stage);

 private:
  Program load(const std::string& stage);

  std::filesystem::path folder_;
  StatMemory& memory_;
  FileDigests& digests_;
  std::map<std::string, std::shared_ptr<const Program>> found_;
};

/// Folder of the executable that is running.
std::filesystem::path own_folder();

}  // namespace sediment::runner
