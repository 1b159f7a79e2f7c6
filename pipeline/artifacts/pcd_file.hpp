#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sediment {

/// One field of the points of a PCD file.
struct PcdField {
  std::string name;
  int bytes = 4;           ///< of one element: 1, 2, 4, 8
  char type = 'F';         ///< F floating point, I signed, U unsigned
  int count = 1;           ///< elements
  std::size_t offset = 0;  ///< of the first element in a point, in bytes
};

/// The header of a PCD file (version 0.7,
/// https://pointclouds.org/documentation/tutorials/pcd_file_format.html).
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t point_bytes = 0;
  std::uint64_t points = 0;
  std::string encoding;         ///< ascii, binary, binary_compressed
  std::size_t body_offset = 0;  ///< of the first byte behind the DATA line

  const PcdField* find(std::string_view name) const;
};

/// Parses the header at the beginning of a file's content. Throws std::runtime_error without the file's name.
PcdHeader parse_pcd_header(std::string_view content);

/// The points as records of `point_bytes` each, whatever the encoding. `unpacked` holds them if they are not
/// in the content as they are. Throws std::runtime_error without the file's name: truncated, not a number.
std::string_view pcd_records(const PcdHeader& header, std::string_view content, std::string& unpacked);

/// Body of a binary_compressed file: two sizes of 32 bits, then the LZF compressed values field by field.
std::string compress_pcd_records(std::string_view records, const std::vector<std::size_t>& field_bytes);

}  // namespace sediment
