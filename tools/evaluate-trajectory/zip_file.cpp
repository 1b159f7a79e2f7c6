#include "tools/evaluate-trajectory/zip_file.hpp"

#include <array>
#include <cstdint>

namespace sediment::tools {
namespace {

std::uint32_t crc32_of(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

/// Little-endian fields of a given number of bytes.
struct Fields {
  std::string bytes;
  Fields& add(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> 8 * i));
    return *this;
  }
};

constexpr std::uint64_t kVersion = 20, kMidnightOf1980 = 0x00210000;

/// What the local and the central header of a file have in common.
std::string description_of(const std::string& name, const std::string& content) {
  Fields fields;
  fields.add(kVersion, 2).add(0x800, 2).add(0, 2).add(kMidnightOf1980, 4).add(crc32_of(content), 4);
  return fields.add(content.size(), 4).add(content.size(), 4).add(name.size(), 2).add(0, 2).bytes;
}

}  // namespace

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    const std::string description = description_of(name, content);
    const std::size_t offset = archive.size();
    archive += Fields().add(0x04034b50, 4).bytes + description + name + content;
    directory += Fields().add(0x02014b50, 4).add(kVersion, 2).bytes + description +
                 Fields().add(0, 2).add(0, 2).add(0, 2).add(0, 4).add(offset, 4).bytes + name;
  }
  Fields end;
  end.add(0x06054b50, 4).add(0, 2).add(0, 2).add(files.size(), 2).add(files.size(), 2);
  end.add(directory.size(), 4).add(archive.size(), 4).add(0, 2);
  return archive + directory + end.bytes;
}

}  // namespace sediment::tools
