#pragma once

#include <filesystem>
#include <optional>

namespace sediment::runner {

/// The right to make one result. The kernel takes it back when its owner dies, however it dies.
class KeyLock {
 public:
  /// Nothing if another runner holds it.
  static std::optional<KeyLock> try_acquire(const std::filesystem::path& file);

  KeyLock(KeyLock&& other) noexcept;
  KeyLock& operator=(KeyLock&& other) noexcept;
  ~KeyLock();

 private:
  KeyLock(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}
  void release();

  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace sediment::runner
