#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace sediment::runner {

/// The right to make one result. All locks of a store lie in one file, each at a place of its own, so that
/// thousands of them make and remove no file. The kernel takes a lock back when its owner dies, however it
/// dies.
class KeyLock {
 public:
  /// Nothing if another runner (or this one) holds it. Throws std::runtime_error if the file cannot be
  /// written.
  static std::optional<KeyLock> try_acquire(const std::filesystem::path& file, std::string_view key);
  /// Looks without taking it.
  static bool is_held(const std::filesystem::path& file, std::string_view key);

  KeyLock(KeyLock&& other) noexcept;
  KeyLock& operator=(KeyLock&& other) noexcept;
  ~KeyLock();

 private:
  explicit KeyLock(int descriptor) : descriptor_(descriptor) {}
  void release();

  int descriptor_;
};

}  // namespace sediment::runner
