#include "pipeline/artifacts/cloud_writer.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "pipeline/artifacts/label_csv.hpp"
#include "pipeline/artifacts/pcd_file.hpp"

namespace sediment {
namespace {

constexpr std::size_t kMostDigits = 20;  ///< of a 64-bit number

/// Of one length whatever the number of points, so that it can be written again once they are counted: the
/// comment makes up for the digits. VIEWPOINT stays the identity: the points are in the world frame, and some
/// viewers apply it once more. An ascii rgb is the whole number of its bits, as a float would not survive the
/// text.
std::string header_of(std::uint64_t points, PcdEncoding encoding) {
  const std::string count = std::to_string(points);
  const char* name = encoding == PcdEncoding::ascii    ? "ascii"
                     : encoding == PcdEncoding::binary ? "binary"
                                                       : "binary_compressed";
  return "# .PCD v0.7 - Point Cloud Data file format" + std::string(2 * (kMostDigits - count.size()), ' ') +
         "\nVERSION 0.7\n" + "FIELDS x y z rgb label instance\nSIZE 4 4 4 4 4 4\nTYPE F F F " +
         (encoding == PcdEncoding::ascii ? "U" : "F") + " U U\nCOUNT 1 1 1 1 1 1\nWIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + name + "\n";
}

std::string ascii_body(std::span<const LabelledPoint> cloud) {
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

std::string_view records_of(std::span<const LabelledPoint> points) {
  return {reinterpret_cast<const char*>(points.data()), points.size_bytes()};
}

}  // namespace

PcdWriter::PcdWriter(std::filesystem::path file, PcdEncoding encoding)
    : file_(std::move(file)), encoding_(encoding) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  opened_.reset(std::fopen(file_.c_str(), "wb"));
  put(header_of(0, encoding_));
}

void PcdWriter::put(std::string_view bytes) {
  if (bytes.empty()) return;
  if (!opened_ || std::fwrite(bytes.data(), 1, bytes.size(), opened_.get()) != bytes.size())
    throw std::runtime_error("cannot write " + file_.string() + ": " + std::strerror(errno));
}

void PcdWriter::append(std::span<const LabelledPoint> points) {
  size_ += points.size();
  switch (encoding_) {
    case PcdEncoding::ascii:
      return put(ascii_body(points));
    case PcdEncoding::binary:
      return put(records_of(points));
    case PcdEncoding::binary_compressed:
      whole_.insert(whole_.end(), points.begin(), points.end());
  }
}

void PcdWriter::finish() {
  if (encoding_ == PcdEncoding::binary_compressed)
    put(compress_pcd_records(records_of(whole_), {4, 4, 4, 4, 4, 4}));
  std::rewind(opened_.get());
  put(header_of(size_, encoding_));
  // A full disk may show itself only here.
  if (std::fclose(opened_.release()) != 0)
    throw std::runtime_error("cannot write " + file_.string() + ": " + std::strerror(errno));
}

CloudWriter::CloudWriter(std::filesystem::path folder, PcdEncoding encoding)
    : folder_(std::move(folder)), pcd_(folder_ / "cloud.pcd", encoding) {}

void CloudWriter::append(std::span<const LabelledPoint> points) {
  pcd_.append(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points[i].label != points[i - 1].label) present_.insert(points[i].label);
}

void CloudWriter::finish(const LabelTable& labels) {
  pcd_.finish();
  write_label_csv(folder_ / "labels.csv", labels, present_);
}

void write_pcd(const std::filesystem::path& file, const LabelledCloud& cloud, PcdEncoding encoding) {
  PcdWriter writer(file, encoding);
  writer.append(cloud);
  writer.finish();
}

void write_cloud(const std::filesystem::path& folder, const LabelledCloud& cloud, const LabelTable& labels,
                 PcdEncoding encoding) {
  CloudWriter writer(folder, encoding);
  writer.append(cloud);
  writer.finish(labels);
}

}  // namespace sediment
