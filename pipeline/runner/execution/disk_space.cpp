#include "pipeline/runner/execution/disk_space.hpp"

#include <stdexcept>

#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner {
namespace {

/// A disk with less room than this has failed somebody.
constexpr std::uint64_t kFull_bytes = 1 << 20;

}  // namespace

void check_room(const std::filesystem::path& store, std::uint64_t expected) {
  const std::uint64_t free = std::filesystem::space(store).available;
  if (expected > free)
    throw std::runtime_error("this run needs about " + shown_bytes(expected) + " on the disk of " +
                             store.string() + ", where " + shown_bytes(free) +
                             " are free; make room or give --no-space-check");
}

std::string full_disk_note(const std::filesystem::path& store) {
  std::error_code unknown;
  const auto space = std::filesystem::space(store, unknown);
  if (unknown || space.available >= kFull_bytes) return "";
  return "; the disk of " + store.string() + " is full";
}

}  // namespace sediment::runner
