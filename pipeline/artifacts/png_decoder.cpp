#include "pipeline/artifacts/png_decoder.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifacts/png_format.hpp"

namespace sediment {
namespace {

using Byte = unsigned char;

struct Free {
  void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

// The header and the compressed rows of a file.
struct Parts {
  std::string_view header;
  std::string rows;
};

std::optional<Parts> parts_of(std::string_view file) {
  if (file.substr(0, kPngSignature.size()) != kPngSignature) return {};
  Parts parts;
  for (std::size_t at = kPngSignature.size(); file.size() - at >= 12;) {
    const std::size_t length = big_endian(file, at);
    if (length > file.size() - at - 12) return {};
    const std::string_view name = file.substr(at + 4, 4), content = file.substr(at + 8, length);
    if (libdeflate_crc32(0, name.data(), 4 + length) != big_endian(file, at + 8 + length)) return {};
    if (name == "IHDR")
      parts.header = content;
    else if (name == "IDAT")
      parts.rows += content;
    else if (name == "IEND")
      return parts.header.size() == 13 ? std::optional(std::move(parts)) : std::nullopt;
    else if (name == "tRNS" || name[0] < 'a')  // transparency, or what must be understood
      return {};
    at += 12 + length;
  }
  return {};
}

// Type of the image, -1 for kinds that are not read here.
int type_of(std::string_view header) {
  const Byte bits = static_cast<Byte>(header[8]), color = static_cast<Byte>(header[9]);
  if (header[10] != 0 || header[11] != 0 || header[12] != 0) return -1;  // compression, filters, interlaced
  constexpr int kGray = 0, kRgb = 2;
  if (color == kGray && bits == 8) return CV_8UC1;
  if (color == kGray && bits == 16) return CV_16UC1;
  return color == kRgb && bits == 8 ? CV_8UC3 : -1;
}

std::vector<Byte> decompressed(const std::string& bytes, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, Free> decompressor(libdeflate_alloc_decompressor());
  if (!decompressor) throw std::bad_alloc();
  std::vector<Byte> rows(size);
  const auto result = libdeflate_zlib_decompress(decompressor.get(), bytes.data(), bytes.size(), rows.data(),
                                                 rows.size(), nullptr);
  if (result != LIBDEFLATE_SUCCESS) rows.clear();
  return rows;
}

// The nearest of three neighbours to what a plane through them has here (PNG specification, section 9.4);
// selections instead of branches, which noise makes unforeseeable.
inline int paeth(int left, int above, int corner) {
  const int along = above - corner, down = left - corner;
  const int by_left = std::abs(along), by_above = std::abs(down), by_corner = std::abs(along + down);
  const int upper = by_above <= by_corner ? above : corner;
  return by_left <= std::min(by_above, by_corner) ? left : upper;
}

// Undoes a filter that predicts a byte from those of the pixels on the left, above, and above that. Both are
// 0 before the first pixel.
template <int Step, class Predict>
void undo(Byte* row, const Byte* above, std::ptrdiff_t size, const Predict& predict) {
  std::array<int, Step> left{}, corner{};
  for (std::ptrdiff_t i = 0; i < size; i += Step)
    for (std::size_t k = 0; k < Step; ++k) {
      const int up = above[i + k];
      left[k] = (row[i + k] + predict(left[k], up, corner[k])) & 0xff;
      row[i + k] = static_cast<Byte>(left[k]);
      corner[k] = up;
    }
}

// Undoes the filter of a row with `Step` bytes a pixel; false if there is no such filter.
template <int Step>
bool unfilter(int filter, Byte* row, const Byte* above, std::ptrdiff_t size) {
  switch (filter) {
    case 0:
      return true;
    case 1:
      undo<Step>(row, above, size, [](int left, int, int) { return left; });
      return true;
    case 2:
      for (std::ptrdiff_t i = 0; i < size; ++i) row[i] = static_cast<Byte>(row[i] + above[i]);
      return true;
    case 3:
      undo<Step>(row, above, size, [](int left, int up, int) { return (left + up) / 2; });
      return true;
    case 4:
      undo<Step>(row, above, size, paeth);
      return true;
    default:
      return false;
  }
}

void copy_row(const Byte* row, cv::Mat& image, int v) {
  if (image.type() == CV_8UC1) {
    std::copy_n(row, image.cols, image.ptr(v));
  } else if (image.type() == CV_16UC1) {
    for (std::ptrdiff_t u = 0; u < image.cols; ++u)
      image.ptr<std::uint16_t>(v)[u] = static_cast<std::uint16_t>(row[2 * u] << 8 | row[2 * u + 1]);
  } else {
    Byte* out = image.ptr(v);
    for (std::ptrdiff_t i = 0; i < 3 * std::ptrdiff_t{image.cols}; i += 3)
      out[i] = row[i + 2], out[i + 1] = row[i + 1], out[i + 2] = row[i];
  }
}

// `filtered`: all rows, each behind the number of its filter.
template <int Step>
cv::Mat image_of(std::vector<Byte> filtered, cv::Mat image) {
  const std::ptrdiff_t size = std::ptrdiff_t{Step} * image.cols;
  std::vector<Byte> none(size, 0);
  const Byte* above = none.data();
  for (int v = 0; v < image.rows; ++v) {
    Byte* row = filtered.data() + v * (size + 1) + 1;
    if (!unfilter<Step>(row[-1], row, above, size)) return {};
    copy_row(row, image, v);
    above = row;
  }
  return image;
}

}  // namespace

cv::Mat decoded_png(std::string_view file) {
  constexpr std::uint32_t kLargest = 1 << 15;
  const auto parts = parts_of(file);
  if (!parts) return {};
  const int type = type_of(parts->header);
  const std::uint32_t width = big_endian(parts->header), height = big_endian(parts->header, 4);
  if (type < 0 || width == 0 || height == 0 || width > kLargest || height > kLargest) return {};
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), type);
  auto filtered = decompressed(parts->rows, (1 + width * image.elemSize()) * height);
  if (filtered.empty()) return {};
  if (type == CV_8UC1) return image_of<1>(std::move(filtered), std::move(image));
  return type == CV_16UC1 ? image_of<2>(std::move(filtered), std::move(image))
                          : image_of<3>(std::move(filtered), std::move(image));
}

}  // namespace sediment
