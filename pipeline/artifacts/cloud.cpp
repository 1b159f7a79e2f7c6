#include "pipeline/artifacts/cloud.hpp"

#include <charconv>
#include <cstring>
#include <set>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_csv.hpp"
#include "pipeline/artifacts/pcd_file.hpp"

namespace sediment {
namespace {

/// VIEWPOINT stays the identity: the points are in the world frame, and some viewers apply it once more.
/// An ascii rgb is the whole number of its bits, as a float would not survive the text.
std::string header_of(std::size_t points, PcdEncoding encoding) {
  const std::string count = std::to_string(points);
  const char* name = encoding == PcdEncoding::ascii    ? "ascii"
                     : encoding == PcdEncoding::binary ? "binary"
                                                       : "binary_compressed";
  return std::string("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n") +
         "FIELDS x y z rgb label instance\nSIZE 4 4 4 4 4 4\nTYPE F F F " +
         (encoding == PcdEncoding::ascii ? "U" : "F") + " U U\nCOUNT 1 1 1 1 1 1\nWIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + name + "\n";
}

std::string ascii_body(const LabelledCloud& cloud) {
  std::string text;
  char buffer[32];
  const auto append = [&](auto value, char end) {
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    text.push_back(end);
  };
  for (const LabelledPoint& point : cloud) {
    append(point.x, ' ');
    append(point.y, ' ');
    append(point.z, ' ');
    append(std::uint32_t{point.r} << 16 | std::uint32_t{point.g} << 8 | point.b, ' ');
    append(point.label, ' ');
    append(point.instance, '\n');
  }
  return text;
}

/// Reads a field of any type as a number.
double number_at(const PcdField& field, const char* record) {
  const auto load = [&](auto value) {
    std::memcpy(&value, record + field.offset, sizeof value);
    return static_cast<double>(value);
  };
  if (field.type == 'F') return field.bytes == 4 ? load(float{}) : load(double{});
  const bool is_signed = field.type == 'I';
  switch (field.bytes) {
    case 1:
      return is_signed ? load(std::int8_t{}) : load(std::uint8_t{});
    case 2:
      return is_signed ? load(std::int16_t{}) : load(std::uint16_t{});
    case 4:
      return is_signed ? load(std::int32_t{}) : load(std::uint32_t{});
    default:
      return is_signed ? load(std::int64_t{}) : load(std::uint64_t{});
  }
}

std::uint32_t id_at(const PcdField* field, const char* record, std::uint32_t otherwise) {
  if (field == nullptr) return otherwise;
  const double value = number_at(*field, record);
  if (!(value >= 0 && value <= 4294967295.0))
    throw std::runtime_error("field " + field->name + " holds " + std::to_string(value) + ", which is no id");
  return static_cast<std::uint32_t>(value);
}

bool is_ours(const PcdHeader& header) {
  constexpr const char* kNames[6] = {"x", "y", "z", "rgb", "label", "instance"};
  bool same = header.fields.size() == 6 && header.point_bytes == sizeof(LabelledPoint);
  for (std::size_t i = 0; same && i < 6; ++i) {
    const PcdField& field = header.fields[i];
    same = field.name == kNames[i] && field.bytes == 4 && field.count == 1 && (field.type == 'F') == (i < 4);
  }
  return same;
}

LabelledCloud cloud_from(const PcdHeader& header, std::string_view records) {
  LabelledCloud cloud(header.points);
  if (is_ours(header)) {
    std::memcpy(static_cast<void*>(cloud.data()), records.data(), records.size());
    return cloud;
  }
  const PcdField *x = header.find("x"), *y = header.find("y"), *z = header.find("z");
  if (x == nullptr || y == nullptr || z == nullptr) throw std::runtime_error("the points have no x y z");
  const PcdField* rgb = header.find("rgb") != nullptr ? header.find("rgb") : header.find("rgba");
  if (rgb != nullptr && rgb->bytes != 4) throw std::runtime_error("the field rgb has not 4 bytes");
  const PcdField *label = header.find("label"), *instance = header.find("instance");
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const char* record = records.data() + i * header.point_bytes;
    LabelledPoint& point = cloud[i];
    point.x = static_cast<float>(number_at(*x, record));
    point.y = static_cast<float>(number_at(*y, record));
    point.z = static_cast<float>(number_at(*z, record));
    point.b = point.g = point.r = 128;
    if (rgb != nullptr) std::memcpy(&point.b, record + rgb->offset, 3);
    point.label = id_at(label, record, kUnlabelled);
    point.instance = id_at(instance, record, 0);
  }
  return cloud;
}

}  // namespace

void write_pcd(const std::filesystem::path& file, const LabelledCloud& cloud, PcdEncoding encoding) {
  const std::string header = header_of(cloud.size(), encoding);
  const std::string_view records(reinterpret_cast<const char*>(cloud.data()),
                                 cloud.size() * sizeof(LabelledPoint));
  switch (encoding) {
    case PcdEncoding::ascii:
      return write_bytes(file, {header, ascii_body(cloud)});
    case PcdEncoding::binary:
      return write_bytes(file, {header, records});
    case PcdEncoding::binary_compressed:
      return write_bytes(file, {header, compress_pcd_records(records, {4, 4, 4, 4, 4, 4})});
  }
}

LabelledCloud read_pcd(const std::filesystem::path& file) {
  const std::string content = read_bytes(file);
  try {
    const PcdHeader header = parse_pcd_header(content);
    std::string unpacked;
    return cloud_from(header, pcd_records(header, content, unpacked));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

void write_cloud(const std::filesystem::path& folder, const LabelledCloud& cloud, const LabelTable& labels,
                 PcdEncoding encoding) {
  write_pcd(folder / "cloud.pcd", cloud, encoding);
  std::set<std::uint32_t> present;
  for (const LabelledPoint& point : cloud) present.insert(point.label);
  write_label_csv(folder / "labels.csv", labels, present);
}

LabelledCloud read_cloud(const std::filesystem::path& folder) {
  return read_pcd(folder / "cloud.pcd");
}

LabelTable read_cloud_labels(const std::filesystem::path& folder) {
  return read_label_csv(folder / "labels.csv");
}

}  // namespace sediment
