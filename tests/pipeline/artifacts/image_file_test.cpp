#include "pipeline/artifacts/image_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tests/support/same_image.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

cv::Mat noise(int type) {
  cv::Mat image(37, 53, type);
  cv::theRNG().state = 42;
  cv::randu(image, 0, 65535);
  return image;
}

}  // namespace

TEST_CASE("images survive writing and reading, and equal images give equal files") {
  const test::TemporaryFolder folder;
  const auto file = folder / "deep" / "image.png";
  const int type = GENERATE(CV_8UC1, CV_8UC3, CV_16UC1);
  const cv::Mat image = noise(type);
  write_png(file, image);
  const cv::Mat read = type == CV_8UC1   ? read_gray8(file)
                       : type == CV_8UC3 ? read_color(file)
                                         : read_gray16(file);
  CHECK(test::same_image(read, image));
  const std::string bytes = read_bytes(file);
  write_png(file, image.clone());
  CHECK(read_bytes(file) == bytes);
  const ImageHeader header = probe_image(file);
  CHECK(header.width == 53);
  CHECK(header.height == 37);
  CHECK(header.bits == (type == CV_16UC1 ? 16 : 8));
  CHECK(header.channels == (type == CV_8UC3 ? 3 : 1));
}

TEST_CASE("the header of a JPEG file is found behind its other segments") {
  const test::TemporaryFolder folder;
  const auto file = folder / "image.jpg";
  const int type = GENERATE(CV_8UC1, CV_8UC3);
  cv::imwrite(file.string(), noise(type), {cv::IMWRITE_JPEG_PROGRESSIVE, GENERATE(0, 1)});
  std::string bytes = read_bytes(file);
  // A long application segment, with what looks like a frame header and an end of image inside.
  std::string segment("\xff\xe1\xff\xfe\xff\xc0\xff\xd9", 8);
  segment.resize(2 + 0xfffe, '\0');
  write_bytes(file, {bytes.insert(2, segment)});
  const ImageHeader header = probe_image(file);
  CHECK(header.width == 53);
  CHECK(header.height == 37);
  CHECK(header.bits == 8);
  CHECK(header.channels == (type == CV_8UC3 ? 3 : 1));
  CHECK(read_color(file).size() == cv::Size(53, 37));
}

TEST_CASE("images that are missing, cut off or of another kind are refused by name") {
  const test::TemporaryFolder folder;
  const std::string extension = GENERATE(".png", ".jpg");
  const auto file = folder / ("image" + extension);
  cv::imwrite(file.string(), noise(CV_8UC3));
  const std::string bytes = read_bytes(file);
  std::string expected;
  SECTION("missing") {
    std::filesystem::remove(file);
    expected = "cannot be read";
  }
  SECTION("a folder") {
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    expected = "cannot be read";
  }
  SECTION("empty") {
    write_bytes(file, {});
    expected = "the file is empty";
  }
  SECTION("half") {
    write_bytes(file, {bytes.substr(0, bytes.size() / 2)});
    expected = "truncated";
  }
  SECTION("a few bytes") {
    write_bytes(file, {bytes.substr(0, 9)});
    expected = "truncated";
  }
  SECTION("zeros") {
    write_bytes(file, {std::string(bytes.size(), '\0')});
    expected = "neither a PNG nor a JPEG file";
  }
  CHECK_THROWS_WITH(probe_image(file), Contains(file.string()) && Contains(expected));
  CHECK_THROWS_WITH(read_color(file), Contains(file.string()) && Contains(expected));
}

TEST_CASE("an image of other bits or channels than asked for is refused") {
  const test::TemporaryFolder folder;
  const auto file = folder / "image.png";
  write_png(file, noise(CV_8UC1));
  CHECK_THROWS_WITH(read_gray16(file), Contains("expected 16 bits in one channel, found 8 bits in 1"));
  write_png(file, noise(CV_8UC3));
  CHECK_THROWS_WITH(read_gray8(file), Contains("expected 8 bits in one channel, found 8 bits in 3"));
  CHECK_THROWS_WITH(write_png(file, cv::Mat(2, 2, CV_32FC1)), Contains(file.string()));
  CHECK_THROWS_WITH(write_png(file, cv::Mat()), Contains(file.string()));
}

TEST_CASE("a full disk is an error that names the file") {
  if (!std::filesystem::exists("/dev/full")) return;
  CHECK_THROWS_WITH(write_png("/dev/full", noise(CV_16UC1)), Contains("/dev/full: No space left on device"));
}
