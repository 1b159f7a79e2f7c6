#include "pipeline/artifacts/lzf.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace sediment {
namespace {

constexpr std::size_t kMaxLiterals = 32, kMaxDistance = 8192, kMaxMatch = 264;
constexpr int kHashBits = 16;

std::uint32_t hash_of(const unsigned char* at) {
  const std::uint32_t three =
      static_cast<std::uint32_t>(at[0]) << 16 | static_cast<std::uint32_t>(at[1]) << 8 | at[2];
  return three * 2654435761u >> (32 - kHashBits);
}

void append_literals(std::string& packed, std::string_view literals) {
  while (!literals.empty()) {
    const std::size_t count = std::min(literals.size(), kMaxLiterals);
    packed.push_back(static_cast<char>(count - 1));
    packed.append(literals.substr(0, count));
    literals.remove_prefix(count);
  }
}

void append_match(std::string& packed, std::size_t distance, std::size_t length) {
  const std::size_t offset = distance - 1, code = length - 2;
  packed.push_back(static_cast<char>(std::min<std::size_t>(code, 7) << 5 | offset >> 8));
  if (code >= 7) packed.push_back(static_cast<char>(code - 7));
  packed.push_back(static_cast<char>(offset & 0xff));
}

}  // namespace

std::string lzf_compress(std::string_view bytes) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  std::vector<std::size_t> last_seen(std::size_t{1} << kHashBits,
                                     0);  // position + 1 of three bytes with a hash
  std::string packed;
  std::size_t at = 0, literals_from = 0;
  while (at + 3 <= bytes.size()) {
    std::size_t& seen = last_seen[hash_of(data + at)];
    const std::size_t candidate = seen;
    seen = at + 1;
    const std::size_t distance = at + 1 - candidate;
    if (candidate == 0 || distance > kMaxDistance ||
        !std::equal(data + at, data + at + 3, data + candidate - 1)) {
      ++at;
      continue;
    }
    const std::size_t longest = std::min(kMaxMatch, bytes.size() - at);
    std::size_t length = 3;
    while (length < longest && data[at + length] == data[at + length - distance]) ++length;
    append_literals(packed, bytes.substr(literals_from, at - literals_from));
    append_match(packed, distance, length);
    at += length;
    literals_from = at;
  }
  append_literals(packed, bytes.substr(literals_from));
  return packed;
}

std::string lzf_decompress(std::string_view packed, std::size_t size) {
  const auto fail = [] { throw std::runtime_error("the compressed bytes are damaged"); };
  std::string bytes;
  bytes.reserve(size);
  for (std::size_t at = 0; at < packed.size();) {
    const auto next = [&] {
      if (at >= packed.size()) fail();
      return static_cast<std::size_t>(static_cast<unsigned char>(packed[at++]));
    };
    const std::size_t control = next();
    if (control < kMaxLiterals) {
      if (at + control + 1 > packed.size() || bytes.size() + control + 1 > size) fail();
      bytes.append(packed.substr(at, control + 1));
      at += control + 1;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) length += next();
    length += 2;
    const std::size_t distance = ((control & 0x1f) << 8) + next() + 1;
    if (distance > bytes.size() || bytes.size() + length > size) fail();
    for (; length > 0; --length)
      bytes.push_back(bytes[bytes.size() - distance]);  // may overlap what it writes
  }
  if (bytes.size() != size) fail();
  return bytes;
}

}  // namespace sediment
