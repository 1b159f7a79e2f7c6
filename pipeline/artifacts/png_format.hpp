#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sediment {

/// What every PNG file begins with (PNG specification, section 5.2).
inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

/// The number that the `count` (at most 4) bytes from `at` on make, most significant first: the order of PNG
/// and JPEG files.
template <class Bytes>
constexpr std::uint32_t big_endian(const Bytes& bytes, std::size_t at = 0, std::size_t count = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace sediment
