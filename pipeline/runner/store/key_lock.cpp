#include "pipeline/runner/store/key_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace sediment::runner {

std::optional<KeyLock> KeyLock::try_acquire(const std::filesystem::path& file) {
  while (true) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      throw std::runtime_error("cannot lock " + file.string() + ": " + std::strerror(errno));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      close(descriptor);
      if (error == EWOULDBLOCK) return std::nullopt;
      throw std::runtime_error("cannot lock " + file.string() + ": " + std::strerror(error));
    }
    // The owner before us removes the file: a lock on a removed file protects nothing.
    struct stat ours {
    }, current{};
    if (fstat(descriptor, &ours) == 0 && stat(file.c_str(), &current) == 0 && ours.st_ino == current.st_ino)
      return KeyLock(file, descriptor);
    close(descriptor);
  }
}

KeyLock::KeyLock(KeyLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

KeyLock& KeyLock::operator=(KeyLock&& other) noexcept {
  if (this == &other) return *this;
  release();
  file_ = std::move(other.file_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

KeyLock::~KeyLock() {
  release();
}

void KeyLock::release() {
  if (descriptor_ < 0) return;
  unlink(file_.c_str());
  close(descriptor_);
  descriptor_ = -1;
}

}  // namespace sediment::runner
