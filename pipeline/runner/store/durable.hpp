#pragma once

#include <filesystem>

namespace sediment::runner {

/// Waits until the content of a file, or the entries of a folder, are on the disk (fsync). Throws
/// std::runtime_error.
void sync_path(const std::filesystem::path& path);

/// The same for a folder with all that is in it.
void sync_tree(const std::filesystem::path& folder);

}  // namespace sediment::runner
