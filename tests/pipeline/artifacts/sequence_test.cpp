#include "pipeline/artifacts/sequence.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "tests/support/needs.hpp"
#include "tests/support/same_image.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

/// A written tiny sequence whose files a test then damages.
struct Written {
  explicit Written(int frames = 3) : sequence(test::tiny_sequence(frames)) {
    yaml = test::write_sequence(folder.path(), sequence);
  }
  void replace_in(const char* file, const std::string& what, const std::string& by) const {
    std::string text = read_bytes(folder / file);
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    write_bytes(folder / file, {text.replace(at, what.size(), by)});
  }
  void append(const char* file, const std::string& text) const {
    write_bytes(folder / file, {read_bytes(folder / file), text});
  }

  test::TemporaryFolder folder;
  test::TinySequence sequence;
  std::filesystem::path yaml;
};

}  // namespace

TEST_CASE("a written sequence reads back pixel for pixel") {
  const Written written;
  const bool by_folder = GENERATE(false, true);
  const Sequence sequence = Sequence::open(by_folder ? written.folder.path() : written.yaml);
  REQUIRE(sequence.size() == 3);
  CHECK(sequence.camera() == written.sequence.camera);
  CHECK(sequence.unassociated() == 0);
  CHECK(sequence.groundtruth() == written.folder / "groundtruth.txt");
  CHECK_FALSE(sequence.accelerometer());
  for (std::size_t i = 0; i < 3; ++i) {
    const Frame frame = sequence.frame(i);
    CHECK(frame.frame_idx == i);
    CHECK(frame.stamp == written.sequence.frames[i].stamp);
    CHECK(test::same_image(frame.color, written.sequence.frames[i].color));
    CHECK(test::same_image(frame.depth, written.sequence.frames[i].depth));
    CHECK(sequence.entry(i).color_line == static_cast<int>(i) + 2);
  }
}

TEST_CASE(
    "windows lines, tabs, comments, blank lines and an unsorted list are read as TUM's tools read them") {
  const Written written;
  write_bytes(written.folder / "rgb.txt", {"# made by hand\r\n\r\n100.040000\trgb/100.040000.png\r\n"
                                           "100.000000,rgb/100.000000.png\r\n# end\r\n"});
  const Sequence sequence = Sequence::open(written.yaml);
  REQUIRE(sequence.size() == 2);
  CHECK(sequence.entry(0).stamp == "100.000000");
  CHECK(sequence.entry(0).color_line == 4);
  CHECK(sequence.entry(1).color_line == 3);
}

TEST_CASE("the window takes every stride-th associated frame from its start") {
  const Written written(10);
  written.append("sequence.yaml", "window: {start: 2, count: 3, stride: 3}\n");
  const Sequence sequence = Sequence::open(written.yaml);
  REQUIRE(sequence.size() == 3);
  CHECK(sequence.entry(0).stamp == "100.080000");
  CHECK(sequence.entry(1).stamp == "100.200000");
  CHECK(sequence.entry(2).stamp == "100.320000");
  CHECK(sequence.unassociated() == 0);
}

TEST_CASE("images without a partner are counted, not used") {
  const Written written(5);
  written.replace_in("depth.txt", "100.084000", "100.064000");  // 16 ms before frame 2: 24 ms behind frame 1
  written.replace_in("depth.txt", "100.124000", "100.146000");  // 26 ms behind frame 3, 14 ms before frame 4
  const Sequence sequence = Sequence::open(written.yaml);
  std::vector<std::string> stamps;
  for (std::size_t i = 0; i < sequence.size(); ++i) stamps.push_back(sequence.entry(i).stamp);
  CHECK(stamps == std::vector<std::string>{"100.000000", "100.040000", "100.080000", "100.160000"});
  CHECK(sequence.unassociated() == 2);  // colour of frame 3 and the depth 26 ms behind it
}

TEST_CASE("a damaged sequence is refused with the line of the list") {
  const Written written;
  const auto color = written.folder / "rgb" / "100.040000.png";
  const auto depth = written.folder / "depth" / "100.044000.png";
  std::string expected = "rgb.txt:3: ";
  SECTION("a colour image is missing") {
    std::filesystem::remove(color);
  }
  SECTION("a colour image is empty") {
    write_bytes(color, {});
  }
  SECTION("a colour image is cut off") {
    const std::string bytes = read_bytes(color);
    write_bytes(color, {bytes.substr(0, bytes.size() - 20)});
  }
  SECTION("a colour image is text") {
    write_bytes(color, {"<html>404</html>"});
  }
  SECTION("a colour image has another size") {
    write_png(color, cv::Mat(48, 63, CV_8UC3, cv::Scalar()));
  }
  SECTION("a depth image has 8 bits") {
    write_png(depth, cv::Mat(48, 64, CV_8UC1, cv::Scalar()));
    expected =
        "depth.txt:3: " + depth.string() + ": expected a depth image of 16 bits in one channel, found 8 bits";
  }
  SECTION("a depth image has another size than the colour images") {
    write_png(depth, cv::Mat(24, 32, CV_16UC1, cv::Scalar()));
    expected =
        "depth.txt:3: " + depth.string() + ": expected 64 x 48 pixels as the camera says, found 32 x 24";
  }
  SECTION("a stamp is given twice, in other words") {
    written.append("rgb.txt", "100.04 rgb/100.040000.png\n");
    expected = "rgb.txt:5: stamp 100.04 is given twice (first in line 3)";
  }
  SECTION("a stamp is no number") {
    written.append("rgb.txt", "nan rgb/100.040000.png\n");
    expected = "rgb.txt:5: expected a number for timestamp, found \"nan\"";
  }
  SECTION("a line has no file name") {
    written.append("depth.txt", "100.2\n");
    expected = "depth.txt:5: expected 2 columns";
  }
  CHECK_THROWS_WITH(Sequence::open(written.yaml), Contains(expected));
}

TEST_CASE("an image that is damaged inside is refused when its frame is read") {
  const Written written;
  const Sequence sequence = Sequence::open(written.yaml);
  const auto color = written.folder / "rgb" / "100.080000.png";
  std::string bytes = read_bytes(color);
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 8; ++i)
    bytes[i] = static_cast<char>(~bytes[i]);
  write_bytes(color, {bytes});
  CHECK_NOTHROW(sequence.frame(1));
  CHECK_THROWS_WITH(sequence.frame(2),
                    Contains("rgb.txt:4: ") && Contains("100.080000.png: cannot be decoded"));
}

TEST_CASE("a wrong sequence file is refused with its line") {
  const Written written;
  std::string expected;
  SECTION("unknown key") {
    written.append("sequence.yaml", "grundtruth: groundtruth.txt\n");
    expected = "sequence.yaml:3: unknown key \"grundtruth\"";
  }
  SECTION("unknown key of the camera") {
    written.replace_in("sequence.yaml", "depth_scale", "depth_scales");
    expected = "sequence.yaml:1: unknown key \"depth_scales\"";
  }
  SECTION("no camera") {
    write_bytes(written.yaml, {"root: .\n"});
    expected = "sequence.yaml:1: \"camera\" is missing";
  }
  SECTION("focal length of 0") {
    written.replace_in("sequence.yaml", "fx: 60", "fx: 0");
    expected = "sequence.yaml:1: fx must be above 0";
  }
  SECTION("no such folder") {
    written.append("sequence.yaml", "root: elsewhere\n");
    expected = "sequence.yaml:3: there is no folder";
  }
  SECTION("no ground truth where one is named") {
    std::filesystem::remove(written.folder / "groundtruth.txt");
    expected = "sequence.yaml:2: there is no file";
  }
  SECTION("window behind the end") {
    written.append("sequence.yaml", "window: {start: 3}\n");
    expected = "the window starts at frame 3, but there are 3";
  }
  SECTION("stride of 0") {
    written.append("sequence.yaml", "window: {stride: 0}\n");
    expected = "sequence.yaml:3: stride must be at least 1";
  }
  SECTION("no YAML") {
    write_bytes(written.yaml, {"camera: [1,\n"});
    expected = "sequence.yaml:";
  }
  SECTION("no depth list") {
    std::filesystem::remove(written.folder / "depth.txt");
    expected = "depth.txt";
  }
  SECTION("no depth near any colour image") {
    write_bytes(written.folder / "depth.txt", {"200 depth/100.044000.png\n"});
    expected = "rgb.txt: no image has a depth image of";
  }
  SECTION("empty list") {
    write_bytes(written.folder / "rgb.txt", {"# nothing\n"});
    expected = "rgb.txt: lists no image";
  }
  CHECK_THROWS_WITH(Sequence::open(written.yaml), Contains(expected));
}

TEST_CASE("the camera may stand in a file of its own, beside the sequence file") {
  const Written written;
  write_bytes(written.folder / "camera.yaml",
              {"width: 64\nheight: 48\nfx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\n"});
  write_bytes(written.yaml, {"camera: camera.yaml\n"});
  CHECK(Sequence::open(written.yaml).camera() == written.sequence.camera);
}

TEST_CASE("real frames of TUM open, associate and decode") {
  const auto root = test::needs("tum/rgbd_dataset_freiburg1_rpy_person");
  if (!root) return;
  const test::TemporaryFolder folder;
  const std::string cameras = SEDIMENT_SOURCE_DIR "/configs/cameras/freiburg1.yaml";
  write_bytes(folder / "sequence.yaml", {"root: ", root->string(), "\ncamera: ", cameras, "\n"});
  const Sequence sequence = Sequence::open(folder.path());
  REQUIRE(sequence.size() == 160);
  CHECK(sequence.entry(0).stamp == "1305031248.197746");
  CHECK(sequence.camera().distortion[0] == 0.2624);
  const Frame frame = sequence.frame(159);
  CHECK(frame.color.type() == CV_8UC3);
  CHECK(frame.depth.type() == CV_16UC1);
  CHECK(cv::countNonZero(frame.depth) > 640 * 480 / 2);
}
