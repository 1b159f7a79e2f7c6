#include "pipeline/artifacts/png_decoder.hpp"

#include <libdeflate.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "pipeline/artifacts/png_encoder.hpp"
#include "tests/support/same_image.hpp"

using namespace sediment;

namespace {

using Byte = unsigned char;

std::string big_endian(std::size_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

std::string chunk(const std::string& name_and_content) {
  return big_endian(name_and_content.size() - 4) + name_and_content +
         big_endian(libdeflate_crc32(0, name_and_content.data(), name_and_content.size()));
}

// Bytes of a row as a PNG file holds them before they are filtered.
std::vector<Byte> bytes_of_row(const cv::Mat& image, int v) {
  std::vector<Byte> bytes(static_cast<std::size_t>(image.cols) * image.elemSize());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t pixel = i / image.elemSize(), part = i % image.elemSize();
    bytes[i] = image.ptr(v)[(pixel + 1) * image.elemSize() - 1 - part];  // RGB of BGR, high byte first
  }
  return bytes;
}

int predicted(int filter, int left, int above, int corner) {
  const int plane = left + above - corner;
  const int by_left = std::abs(plane - left), by_above = std::abs(plane - above),
            by_corner = std::abs(plane - corner);
  const int paeth = by_left <= by_above && by_left <= by_corner ? left
                    : by_above <= by_corner                     ? above
                                                                : corner;
  return std::vector<int>{0, left, above, (left + above) / 2, paeth}.at(filter);
}

// The rows of an image under the filters of the PNG specification, one after the other.
std::string filtered_rows(const cv::Mat& image) {
  const std::size_t step = image.elemSize();
  std::string rows;
  std::vector<Byte> above(step * image.cols, 0);
  for (int v = 0; v < image.rows; ++v) {
    const int filter = (v + 4) % 5;  // the first row under the one that looks at most neighbours
    const std::vector<Byte> row = bytes_of_row(image, v);
    rows += static_cast<char>(filter);
    for (std::size_t i = 0; i < row.size(); ++i)
      rows += static_cast<char>(
          row[i] - predicted(filter, i < step ? 0 : row[i - step], above[i], i < step ? 0 : above[i - step]));
    above = row;
  }
  return rows;
}

std::string zlib_of(const std::string& bytes) {
  libdeflate_compressor* const compressor = libdeflate_alloc_compressor(6);
  std::string packed(libdeflate_zlib_compress_bound(compressor, bytes.size()), '\0');
  packed.resize(
      libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), packed.data(), packed.size()));
  libdeflate_free_compressor(compressor);
  return packed;
}

// A file whose compressed rows are in two pieces with a comment before them.
std::string png_with(const cv::Mat& image, const std::string& rows) {
  const std::string packed = zlib_of(rows);
  const std::string kind{static_cast<char>(8 * image.elemSize1()),
                         static_cast<char>(image.channels() == 3 ? 2 : 0), 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR" + big_endian(image.cols) + big_endian(image.rows) + kind) +
         chunk("tEXtauthor") + chunk("IDAT" + packed.substr(0, packed.size() / 2)) +
         chunk("IDAT" + packed.substr(packed.size() / 2)) + chunk("IEND");
}

// Smooth in one half, noise in the other: all predictions occur.
cv::Mat picture(int type) {
  cv::Mat image(23, 41, type);
  cv::theRNG().state = 7;
  cv::randu(image, 0, 65535);
  image.colRange(0, 20).setTo(cv::Scalar::all(200));
  return image;
}

}  // namespace

TEST_CASE("PNG images under all filters are decoded as OpenCV decodes them") {
  const cv::Mat image = picture(GENERATE(CV_8UC1, CV_16UC1, CV_8UC3));
  std::string file = png_with(image, filtered_rows(image));
  const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8UC1, file.data());
  REQUIRE(test::same_image(cv::imdecode(bytes, cv::IMREAD_UNCHANGED), image));
  CHECK(test::same_image(decoded_png(file), image));
  CHECK(test::same_image(decoded_png(png_of(image)), image));
}

TEST_CASE("a damaged PNG file is not decoded, wherever it is cut or a byte of it is changed") {
  const cv::Mat image = picture(CV_16UC1);
  const std::string file = png_with(image, filtered_rows(image));
  for (std::size_t i = 0; i < file.size(); ++i) {
    std::string changed = file;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    CAPTURE(i);
    CHECK(decoded_png(changed).empty());
    CHECK(decoded_png(file.substr(0, i)).empty());
  }
  std::string rows = filtered_rows(image);
  rows[0] = 5;
  CHECK(decoded_png(png_with(image, rows)).empty());
  CHECK(decoded_png(png_with(image, rows.substr(1))).empty());
  CHECK(decoded_png(png_with(image, rows + "more")).empty());
}

TEST_CASE("kinds of PNG files that are left to OpenCV are not decoded") {
  std::vector<Byte> bytes;
  cv::imencode(".png", picture(GENERATE(CV_8UC4, CV_16UC3)), bytes);
  CHECK(decoded_png({reinterpret_cast<const char*>(bytes.data()), bytes.size()}).empty());
  CHECK(decoded_png("").empty());
}
