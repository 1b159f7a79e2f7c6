#include "pipeline/artifacts/png_encoder.hpp"

#include <libdeflate.h>

#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "pipeline/artifacts/png_format.hpp"

namespace sediment {
namespace {

using Byte = unsigned char;

constexpr int kFastest = 1;
enum Filter : Byte { kNone = 0, kSub = 1 };  // of a row: as it is, or differences to the pixel on the left

struct Free {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

void append_big_endian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
}

void append_chunk(std::string& file, const char* name, std::string_view content) {
  append_big_endian(file, static_cast<std::uint32_t>(content.size()));
  const std::size_t checked_from = file.size();
  file.append(name).append(content);
  append_big_endian(file, libdeflate_crc32(0, file.data() + checked_from, file.size() - checked_from));
}

std::string header_of(const cv::Mat& image) {
  constexpr char kGrey = 0, kRgb = 2;
  std::string header;
  append_big_endian(header, static_cast<std::uint32_t>(image.cols));
  append_big_endian(header, static_cast<std::uint32_t>(image.rows));
  header += static_cast<char>(8 * image.elemSize1());
  header += image.channels() == 3 ? kRgb : kGrey;
  return header.append(
      3, '\0');  // compression, filters and order of rows: the only ones there are, not interlaced
}

// Noisy colours repeat no strings, but their differences are small numbers, which take few bits. Depth in a
// sensor's steps and masks are few values in long runs: as they are.
void append_color_row(const Byte* bgr, int width, Byte* out) {
  *out++ = kSub;
  out[0] = bgr[2], out[1] = bgr[1], out[2] = bgr[0];
  for (int u = 1; u < width; ++u) {
    const Byte* pixel = bgr + std::ptrdiff_t{3} * u;
    Byte* difference = out + std::ptrdiff_t{3} * u;
    difference[0] = static_cast<Byte>(pixel[2] - pixel[-1]);
    difference[1] = static_cast<Byte>(pixel[1] - pixel[-2]);
    difference[2] = static_cast<Byte>(pixel[0] - pixel[-3]);
  }
}

void append_gray16_row(const std::uint16_t* gray, int width, Byte* out) {
  *out++ = kNone;
  for (int u = 0; u < width; ++u) {
    *out++ = static_cast<Byte>(gray[u] >> 8);
    *out++ = static_cast<Byte>(gray[u] & 0xff);
  }
}

/// All rows, each behind the number of its filter.
std::vector<Byte> filtered(const cv::Mat& image) {
  const std::size_t stride = 1 + static_cast<std::size_t>(image.cols) * image.elemSize();
  std::vector<Byte> rows(stride * static_cast<std::size_t>(image.rows));
  for (int v = 0; v < image.rows; ++v) {
    Byte* out = rows.data() + stride * static_cast<std::size_t>(v);
    if (image.type() == CV_8UC3)
      append_color_row(image.ptr(v), image.cols, out);
    else if (image.type() == CV_16UC1)
      append_gray16_row(image.ptr<std::uint16_t>(v), image.cols, out);
    else
      *out = kNone, std::copy_n(image.ptr(v), image.cols, out + 1);
  }
  return rows;
}

std::string compressed(const std::vector<Byte>& rows) {
  const std::unique_ptr<libdeflate_compressor, Free> compressor(libdeflate_alloc_compressor(kFastest));
  if (!compressor) throw std::bad_alloc();
  std::string bytes(libdeflate_zlib_compress_bound(compressor.get(), rows.size()), '\0');
  bytes.resize(
      libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace

std::string png_of(const cv::Mat& image) {
  std::string file(kPngSignature);
  append_chunk(file, "IHDR", header_of(image));
  append_chunk(file, "IDAT", compressed(filtered(image)));
  append_chunk(file, "IEND", {});
  return file;
}

}  // namespace sediment
