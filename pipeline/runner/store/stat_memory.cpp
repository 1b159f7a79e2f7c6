#include "pipeline/runner/store/stat_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>

#include "pipeline/contract/digest.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

// The file: this line, records, and the digest of all before it. A record is the stat, two lengths, name,
// value.
constexpr std::string_view kHeader = "sediment-stat-memory 1\n";
constexpr std::size_t kDigestLength = 3 + 32;
constexpr std::int64_t kRacy_ns = 2'000'000'000;

struct RecordHead {
  FileStat stat;
  std::uint32_t name_length, value_length;
};

std::string read_all(const fs::path& file) {
  std::string text;
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return text;
  struct stat raw {};
  if (fstat(descriptor, &raw) == 0) text.resize(static_cast<std::size_t>(raw.st_size));
  std::size_t at = 0;
  for (ssize_t count; at < text.size() && (count = read(descriptor, text.data() + at, text.size() - at)) > 0;)
    at += static_cast<std::size_t>(count);
  text.resize(at);
  close(descriptor);
  return text;
}

std::string name_in_memory(StatMemory::Use use, std::string_view path) {
  return static_cast<char>(use) + std::string(path);
}

}  // namespace

FileStat file_stat(const struct stat& raw) {
  const auto ns = [](const timespec& time) {
    return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
  };
  return {raw.st_dev, raw.st_ino, static_cast<std::uint64_t>(raw.st_size), ns(raw.st_mtim), ns(raw.st_ctim)};
}

std::optional<FileStat> stat_of(const char* file) {
  struct stat raw {};
  if (stat(file, &raw) != 0) return std::nullopt;
  return file_stat(raw);
}

StatMemory::StatMemory(fs::path file) : file_(std::move(file)), loaded_(read_all(file_)) {
  std::string_view rest = loaded_;
  if (!rest.starts_with(kHeader) || rest.size() < kHeader.size() + kDigestLength) return;
  const std::string_view digest = rest.substr(rest.size() - kDigestLength);
  rest.remove_suffix(kDigestLength);
  if (contract::digest_bytes(rest) != digest) return;
  rest.remove_prefix(kHeader.size());
  entries_.reserve(rest.size() / 128);
  while (rest.size() >= sizeof(RecordHead)) {
    RecordHead head;
    std::memcpy(&head, rest.data(), sizeof head);
    rest.remove_prefix(sizeof head);
    const std::string_view name = rest.substr(0, head.name_length);
    entries_[name] = {head.stat, rest.substr(name.size(), head.value_length)};
    rest.remove_prefix(name.size() + head.value_length);
  }
}

std::optional<std::string_view> StatMemory::recall(Use use, std::string_view path,
                                                   const FileStat& stat) const {
  const auto found = entries_.find(name_in_memory(use, path));
  if (found == entries_.end() || !(found->second.stat == stat)) return std::nullopt;
  return found->second.value;
}

void StatMemory::remember(Use use, const std::string& path, const FileStat& stat, std::string value,
                          bool may_change) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  if (may_change && std::max(stat.modified_ns, stat.changed_ns) + kRacy_ns > now_ns) return;
  const std::string_view name = learnt_.emplace_back(name_in_memory(use, path));
  entries_[name] = {stat, learnt_.emplace_back(std::move(value))};
  changed_ = true;
}

void StatMemory::forget(Use use, std::string_view path) {
  changed_ |= entries_.erase(name_in_memory(use, path)) > 0;
}

void StatMemory::save() {
  if (!changed_) return;
  changed_ = false;
  std::string text(kHeader);
  for (const auto& [name, entry] : entries_) {
    const RecordHead head{entry.stat, static_cast<std::uint32_t>(name.size()),
                          static_cast<std::uint32_t>(entry.value.size())};
    text.append(reinterpret_cast<const char*>(&head), sizeof head).append(name).append(entry.value);
  }
  text += contract::digest_bytes(text);
  const fs::path fresh = file_.string() + '.' + std::to_string(getpid());
  std::ofstream stream(fresh, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code ignored;
  if (stream) fs::rename(fresh, file_, ignored);
  if (!stream || ignored) fs::remove(fresh, ignored);
}

}  // namespace sediment::runner
