#include "pipeline/runner/store/key_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "pipeline/contract/digest.hpp"

namespace sediment::runner {
namespace {

/// One byte at a place that the key decides, exclusively. Two keys at one place would only wait for each
/// other.
struct flock place_of(std::string_view key) {
  constexpr std::size_t kDigits = 15;  // of 4 bits: off_t has 63
  const std::string digest = contract::digest_bytes(key);
  struct flock place {};
  place.l_type = F_WRLCK;
  place.l_whence = SEEK_SET;
  place.l_start = static_cast<off_t>(std::stoull(digest.substr(digest.find(':') + 1, kDigits), nullptr, 16));
  place.l_len = 1;
  return place;
}

}  // namespace

std::optional<KeyLock> KeyLock::try_acquire(const std::filesystem::path& file, std::string_view key) {
  // A lock belongs to the open file, not to the process: a child that inherits nothing of it cannot free it,
  // and two locks of one process exclude each other.
  KeyLock lock(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  struct flock place = place_of(key);
  if (lock.descriptor_ >= 0 && fcntl(lock.descriptor_, F_OFD_SETLK, &place) == 0) return lock;
  if (lock.descriptor_ >= 0 && (errno == EAGAIN || errno == EACCES)) return std::nullopt;
  throw std::runtime_error("cannot lock " + file.string() + ": " + std::strerror(errno));
}

bool KeyLock::is_held(const std::filesystem::path& file, std::string_view key) {
  const KeyLock look(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct flock place = place_of(key);
  return look.descriptor_ >= 0 && fcntl(look.descriptor_, F_OFD_GETLK, &place) == 0 &&
         place.l_type != F_UNLCK;
}

KeyLock::KeyLock(KeyLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

KeyLock& KeyLock::operator=(KeyLock&& other) noexcept {
  if (this == &other) return *this;
  release();
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

KeyLock::~KeyLock() {
  release();
}

void KeyLock::release() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
}

}  // namespace sediment::runner
