#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace sediment::runner {

/// Throws std::runtime_error that says so if `expected` bytes have no room on the disk of the store.
void check_room(const std::filesystem::path& store, std::uint64_t expected);

/// "; the disk of STORE is full" if it is, else nothing: what to add to the error of a stage, whose own words
/// may hide it.
std::string full_disk_note(const std::filesystem::path& store);

}  // namespace sediment::runner
