#include "pipeline/artifacts/image_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/png_decoder.hpp"
#include "pipeline/artifacts/png_encoder.hpp"
#include "pipeline/artifacts/png_format.hpp"

namespace sediment {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::array<unsigned char, 8> kPngEnd{'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};

Bytes read_at(std::ifstream& stream, std::streamoff offset, std::size_t count) {
  Bytes bytes(count);
  stream.clear();
  stream.seekg(offset);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// The last bytes of the file: other programs may append a little to an image.
bool ends_with(std::ifstream& stream, std::streamoff size, const unsigned char* mark, std::size_t length) {
  constexpr std::streamoff kTail = 1024;
  const Bytes tail = read_at(stream, std::max<std::streamoff>(0, size - kTail), kTail);
  return std::search(tail.begin(), tail.end(), mark, mark + length) != tail.end();
}

int number(const Bytes& bytes, std::size_t at, std::size_t count) {
  return static_cast<int>(big_endian(bytes, at, count));
}

ImageHeader png_header(const Bytes& head) {
  // Colour types: 0 grey, 2 RGB, 3 palette of RGB, 4 grey and alpha, 6 RGB and alpha.
  constexpr int kChannels[7] = {1, 0, 3, 3, 2, 0, 4};
  ImageHeader header{number(head, 16, 4), number(head, 20, 4), head[24], 0};
  if (head[25] < 7) header.channels = kChannels[head[25]];
  return header;
}

/// Walks over the segments of a JPEG file to the frame header (SOF0 .. SOF15).
ImageHeader jpeg_header(std::ifstream& stream, const std::string& name) {
  for (std::streamoff at = 2;;) {
    const Bytes segment = read_at(stream, at, 10);
    if (segment.size() < 10 || segment[0] != 0xff) throw std::runtime_error(name + ": damaged JPEG header");
    const int marker = segment[1];
    const bool fill = marker == 0xff, bare = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7);
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame)
      return {number(segment, 7, 2), number(segment, 5, 2), segment[4],
              static_cast<int>(read_at(stream, at + 9, 1).at(0))};
    if (marker == 0xda || marker == 0xd9) throw std::runtime_error(name + ": JPEG without a frame header");
    at += fill ? 1 : bare ? 2 : 2 + number(segment, 2, 2);
  }
}

cv::Mat decode(const std::filesystem::path& file, int flags, int channels) {
  const std::string bytes = read_bytes(file);
  cv::Mat image = decoded_png(bytes);
  if (!image.empty() && image.channels() == channels) return image;
  try {
    const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    image = cv::imdecode(view, flags);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(file.string() + ": cannot be decoded: " + error.err);
  }
  if (image.empty()) throw std::runtime_error(file.string() + ": cannot be decoded: damaged image");
  return image;
}

cv::Mat read_gray(const std::filesystem::path& file, int bits) {
  const ImageHeader header = probe_image(file);
  if (header.bits != bits || header.channels != 1)
    throw std::runtime_error(file.string() + ": expected " + std::to_string(bits) +
                             " bits in one channel, found " + std::to_string(header.bits) + " bits in " +
                             std::to_string(header.channels) + " channels");
  return decode(file, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION, 1);
}

}  // namespace

ImageHeader probe_image(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0 || std::filesystem::is_directory(file))
    throw std::runtime_error(file.string() + ": cannot be read");
  const Bytes head = read_at(stream, 0, 33);
  ImageHeader header;
  bool whole = false;
  if (std::string_view(reinterpret_cast<const char*>(head.data()), head.size()).starts_with(kPngSignature)) {
    whole = head.size() == 33 && ends_with(stream, size, kPngEnd.data(), kPngEnd.size());
    if (whole) header = png_header(head);
  } else if (head.size() >= 3 && head[0] == 0xff && head[1] == 0xd8 && head[2] == 0xff) {
    constexpr unsigned char kEndOfImage[2] = {0xff, 0xd9};
    whole = ends_with(stream, size, kEndOfImage, 2);
    if (whole) header = jpeg_header(stream, file.string());
  } else {
    throw std::runtime_error(file.string() +
                             (size == 0 ? ": the file is empty" : ": neither a PNG nor a JPEG file"));
  }
  if (!whole) throw std::runtime_error(file.string() + ": truncated image (its end is missing)");
  if (header.width <= 0 || header.height <= 0 || header.channels == 0)
    throw std::runtime_error(file.string() + ": damaged image header");
  return header;
}

cv::Mat read_color(const std::filesystem::path& file) {
  probe_image(file);
  return decode(file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION, 3);
}

cv::Mat read_gray16(const std::filesystem::path& file) {
  return read_gray(file, 16);
}

cv::Mat read_gray8(const std::filesystem::path& file) {
  return read_gray(file, 8);
}

void write_png(const std::filesystem::path& file, const cv::Mat& image) {
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_8UC3 && image.type() != CV_16UC1))
    throw std::runtime_error("cannot write " + file.string() +
                             ": only images of 8 bit grey, 8 bit BGR or 16 bit grey can be written");
  write_bytes(file, {png_of(image)});
}

}  // namespace sediment
