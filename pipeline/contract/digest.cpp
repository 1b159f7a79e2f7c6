#include "pipeline/contract/digest.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

namespace sediment::contract {
namespace {

std::string text_of(XXH128_hash_t hash) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, hash);
  std::string text = "x3:";
  constexpr char digits[] = "0123456789abcdef";
  for (const unsigned char byte : canonical.digest) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::runtime_error("cannot read " + file.string() + ": " + std::strerror(errno));
}

/// Closes its file descriptor at the end of the scope.
struct OpenFile {
  int descriptor;
  explicit OpenFile(const std::filesystem::path& file)
      : descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor < 0) fail(file);
  }
  ~OpenFile() { close(descriptor); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
};

}  // namespace

std::string digest_bytes(std::string_view bytes) {
  return text_of(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string digest_file(const std::filesystem::path& file) {
  const OpenFile opened(file);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> buffer(1 << 18);
  while (true) {
    const ssize_t count = read(opened.descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(file);
    if (count == 0) break;
    XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(count));
  }
  return text_of(XXH3_128bits_digest(state.get()));
}

}  // namespace sediment::contract
