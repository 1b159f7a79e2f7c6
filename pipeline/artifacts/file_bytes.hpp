#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sediment {

/// The whole content of a file. Throws std::runtime_error that names the file.
std::string read_bytes(const std::filesystem::path& file);

/// Writes the parts one after the other and makes missing folders. Throws std::runtime_error that names the
/// file and the reason, also if the disk is full.
void write_bytes(const std::filesystem::path& file, std::initializer_list<std::string_view> parts);

}  // namespace sediment
