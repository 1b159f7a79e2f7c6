#include "pipeline/artifacts/file_bytes.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace sediment {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void fail(const char* what, const std::filesystem::path& file) {
  throw std::runtime_error(std::string("cannot ") + what + " " + file.string() + ": " + std::strerror(errno));
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code code;
  if (std::filesystem::is_directory(file, code)) {
    errno = EISDIR;
    fail("read", file);
  }
  const std::unique_ptr<std::FILE, Close> opened(std::fopen(file.c_str(), "rb"));
  if (opened == nullptr) fail("read", file);
  const auto size = std::filesystem::file_size(file, code);
  std::string bytes(code ? 0 : size, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), opened.get()));
  char more[4096];  // of a file that grows, or that has no size beforehand
  while (const std::size_t count = std::fread(more, 1, sizeof more, opened.get())) bytes.append(more, count);
  if (std::ferror(opened.get())) fail("read", file);
  return bytes;
}

void write_bytes(const std::filesystem::path& file, std::initializer_list<std::string_view> parts) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::unique_ptr<std::FILE, Close> opened(std::fopen(file.c_str(), "wb"));
  if (opened == nullptr) fail("write", file);
  for (const std::string_view part : parts)
    if (std::fwrite(part.data(), 1, part.size(), opened.get()) != part.size()) fail("write", file);
  // A full disk may show itself only here.
  if (std::fclose(opened.release()) != 0) fail("write", file);
}

}  // namespace sediment
