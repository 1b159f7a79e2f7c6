#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sediment::contract {

/// Content identifiers carry their algorithm: "x3:" and the 32 hex digits of XXH3-128.
std::string digest_bytes(std::string_view bytes);

/// Digest of a file's content. Throws std::runtime_error naming the file if it cannot be read.
std::string digest_file(const std::filesystem::path& file);

}  // namespace sediment::contract
