#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sediment::runner {

/// The absolute path of a store. Throws contract::UsageError if the folder is there and is no store of this
/// version.
std::filesystem::path checked_store(const std::filesystem::path& root);

/// Makes the folders of a store.
void make_store(const std::filesystem::path& root);

/// The file of all locks.
std::filesystem::path lock_file(const std::filesystem::path& root);

/// The stat memory of this host.
std::filesystem::path index_file(const std::filesystem::path& root);

/// An id without its algorithm: a file name.
std::string bare(const std::string& id);

/// "ab/cdef...": where an object or a receipt lies in its folder, so that no folder gets too large.
std::string object_name(const std::string& id);

/// The entries of all FOLDER/ab/, sorted.
std::vector<std::filesystem::path> sharded_entries(const std::filesystem::path& folder);

/// Name of this machine.
std::string host_name();

}  // namespace sediment::runner
