#include "pipeline/artifacts/pcd_file.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "pipeline/artifacts/lzf.hpp"

namespace sediment {
namespace {

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> found;
  for (std::string word; stream >> word;) found.push_back(word);
  return found;
}

std::uint64_t whole(const std::string& word, std::uint64_t max) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value > max)
    throw std::runtime_error("PCD header: expected a whole number, found \"" + word + "\"");
  return value;
}

void set_fields(PcdHeader& header, const std::vector<std::string>& line) {
  if (line[0] != "FIELDS" && line.size() != header.fields.size() + 1)
    throw std::runtime_error("PCD header: " + line[0] + " does not fit FIELDS");
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[0] == "FIELDS") header.fields.push_back({line[i]});
    if (line[0] == "SIZE") header.fields[i - 1].bytes = static_cast<int>(whole(line[i], 8));
    if (line[0] == "TYPE") header.fields[i - 1].type = line[i][0];
    if (line[0] == "COUNT") header.fields[i - 1].count = static_cast<int>(whole(line[i], 1 << 20));
  }
}

void lay_out(PcdHeader& header) {
  if (header.fields.empty()) throw std::runtime_error("not a PCD file: its header has no FIELDS");
  for (PcdField& field : header.fields) {
    const bool floating = field.type == 'F' && (field.bytes == 4 || field.bytes == 8);
    const bool integral = (field.type == 'U' || field.type == 'I') &&
                          (field.bytes == 1 || field.bytes == 2 || field.bytes == 4 || field.bytes == 8);
    if (!floating && !integral)
      throw std::runtime_error("PCD header: field " + field.name + " has no known type");
    field.offset = header.point_bytes;
    header.point_bytes += static_cast<std::size_t>(field.bytes) * field.count;
  }
}

/// Packs one written value as the field wants it. An rgb that is a float in the file may be written as the
/// whole number of its bits: that is how PCL writes it.
void pack(const PcdField& field, const std::string& word, char* to) {
  const bool bits_of_float = field.type == 'F' && field.bytes == 4 &&
                             (field.name == "rgb" || field.name == "rgba") &&
                             word.find_first_not_of("0123456789") == std::string::npos;
  if (field.type == 'F' && !bits_of_float) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument)
      throw std::runtime_error("expected a number for " + field.name + ", found \"" + word + "\"");
    const float narrow = static_cast<float>(value);
    std::memcpy(to, field.bytes == 4 ? static_cast<const void*>(&narrow) : &value, field.bytes);
    return;
  }
  const bool negative = field.type == 'I' && word.starts_with('-');
  const std::uint64_t magnitude =
      whole(negative ? word.substr(1) : word, std::numeric_limits<std::uint64_t>::max());
  const std::uint64_t value = negative ? 0 - magnitude : magnitude;
  std::memcpy(to, &value, field.bytes);  // little endian
}

void unpack_ascii(const PcdHeader& header, std::string_view body, std::string& records) {
  std::istringstream stream{std::string(body)};
  std::string word;
  for (std::uint64_t point = 0; point < header.points; ++point)
    for (const PcdField& field : header.fields)
      for (int element = 0; element < field.count; ++element) {
        if (!(stream >> word))
          throw std::runtime_error("truncated: " + std::to_string(header.points) + " points expected, " +
                                   std::to_string(point) + " found");
        pack(field, word, records.data() + point * header.point_bytes + field.offset + element * field.bytes);
      }
}

void unpack_lzf(const PcdHeader& header, std::string_view body, std::string& records) {
  std::uint32_t sizes[2] = {0, 0};
  if (body.size() >= sizeof sizes) std::memcpy(sizes, body.data(), sizeof sizes);
  if (body.size() < sizeof sizes + sizes[0] || sizes[1] != records.size())
    throw std::runtime_error("truncated: the compressed points are not whole");
  const std::string columns = lzf_decompress(body.substr(sizeof sizes, sizes[0]), records.size());
  std::size_t at = 0;
  for (const PcdField& field : header.fields) {
    const std::size_t bytes = static_cast<std::size_t>(field.bytes) * field.count;
    for (std::uint64_t point = 0; point < header.points; ++point, at += bytes)
      std::memcpy(records.data() + point * header.point_bytes + field.offset, columns.data() + at, bytes);
  }
}

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  for (const PcdField& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

PcdHeader parse_pcd_header(std::string_view content) {
  PcdHeader header;
  std::uint64_t width = 0, height = 1;
  bool points_given = false;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = content.find('\n', at);
    if (end == std::string_view::npos) break;
    const auto line = words(std::string(content.substr(at, end - at)));
    at = end + 1;
    if (line.empty() || line[0].starts_with('#') || line[0] == "VIEWPOINT") continue;
    if (line.size() < 2) throw std::runtime_error("not a PCD file: line \"" + line[0] + "\" in its header");
    if (line[0] == "VERSION") {
      if (line[1] != "0.7" && line[1] != ".7" && line[1] != "0.6" && line[1] != ".6")
        throw std::runtime_error("PCD version " + line[1] + " is not known (expected 0.7)");
    } else if (line[0] == "FIELDS" || line[0] == "SIZE" || line[0] == "TYPE" || line[0] == "COUNT") {
      set_fields(header, line);
    } else if (line[0] == "WIDTH") {
      width = whole(line[1], std::uint64_t{1} << 40);
    } else if (line[0] == "HEIGHT") {
      height = whole(line[1], std::uint64_t{1} << 20);
    } else if (line[0] == "POINTS") {
      header.points = whole(line[1], std::uint64_t{1} << 40);
      points_given = true;
    } else if (line[0] == "DATA") {
      if (line[1] != "ascii" && line[1] != "binary" && line[1] != "binary_compressed")
        throw std::runtime_error("PCD encoding " + line[1] + " is not known");
      header.encoding = line[1];
      header.body_offset = at;
      if (!points_given) header.points = width * height;
      lay_out(header);
      return header;
    } else {
      throw std::runtime_error("not a PCD file: \"" + line[0].substr(0, 20) + "\" in its header");
    }
  }
  throw std::runtime_error("not a whole PCD file: its header has no DATA line");
}

std::string_view pcd_records(const PcdHeader& header, std::string_view content, std::string& unpacked) {
  const std::string_view body = content.substr(header.body_offset);
  const std::uint64_t bytes = header.points * header.point_bytes;
  if (header.encoding == "binary") {
    if (body.size() < bytes)
      throw std::runtime_error("truncated: " + std::to_string(header.points) + " points need " +
                               std::to_string(bytes) + " bytes, " + std::to_string(body.size()) + " found");
    return body.substr(0, bytes);
  }
  // Even an ascii value takes two bytes and LZF packs 264 to 3: a header that claims more is damaged.
  if (bytes / 512 > body.size()) throw std::runtime_error("truncated: fewer points than its header says");
  unpacked.assign(bytes, '\0');
  if (header.encoding == "ascii")
    unpack_ascii(header, body, unpacked);
  else
    unpack_lzf(header, body, unpacked);
  return unpacked;
}

std::string compress_pcd_records(std::string_view records, const std::vector<std::size_t>& field_bytes) {
  if (records.size() >= std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error("the encoding binary_compressed holds less than 4 GiB: use binary");
  std::size_t point_bytes = 0;
  for (const std::size_t bytes : field_bytes) point_bytes += bytes;
  std::string columns(records.size(), '\0');
  std::size_t at = 0, offset = 0;
  for (const std::size_t bytes : field_bytes) {
    for (std::size_t point = 0; point < records.size(); point += point_bytes, at += bytes)
      std::memcpy(columns.data() + at, records.data() + point + offset, bytes);
    offset += bytes;
  }
  const std::string packed = lzf_compress(columns);
  if (packed.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error("the encoding binary_compressed holds less than 4 GiB: use binary");
  const std::uint32_t sizes[2] = {static_cast<std::uint32_t>(packed.size()),
                                  static_cast<std::uint32_t>(columns.size())};
  std::string body(reinterpret_cast<const char*>(sizes), sizeof sizes);
  body += packed;
  return body;
}

}  // namespace sediment
