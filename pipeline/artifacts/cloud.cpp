#include "pipeline/artifacts/cloud.hpp"

#include <cstring>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_csv.hpp"
#include "pipeline/artifacts/pcd_file.hpp"

namespace sediment {
namespace {

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
    if (!cloud.empty()) std::memcpy(static_cast<void*>(cloud.data()), records.data(), records.size());
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

LabelledCloud read_cloud(const std::filesystem::path& folder) {
  return read_pcd(folder / "cloud.pcd");
}

LabelTable read_cloud_labels(const std::filesystem::path& folder) {
  return read_label_csv(folder / "labels.csv");
}

}  // namespace sediment
