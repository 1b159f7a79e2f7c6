#pragma once

#include <string>
#include <string_view>

namespace sediment {

/// The LZF coding of binary_compressed PCD files. Its two kinds of token:
///   000lllll                    the next l + 1 bytes are literal
///   LLLooooo [length] oooooooo  copies L + 2 bytes (L = 7: the extra byte is added) from o + 1 bytes before
/// Done here because linking PCL's own would load its viewers into every stage.
std::string lzf_compress(std::string_view bytes);

/// Throws std::runtime_error if the result would not have exactly `size` bytes.
std::string lzf_decompress(std::string_view packed, std::size_t size);

}  // namespace sediment
