#include "pipeline/artifacts/sequence.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/support/needs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;

TEST_CASE("real frames of TUM open, associate and decode") {
  const auto root = test::needs("tum/rgbd_dataset_freiburg1_rpy_person");
  if (!root) return;
  const test::TemporaryFolder folder;
  std::ofstream(folder / "sequence.yaml")
      << "root: " << root->string()
      << "\ncamera: {width: 640, height: 480, fx: 517.3, fy: 516.5, cx: 318.6, "
         "cy: 255.3}\ngroundtruth: groundtruth.txt\n";
  const Sequence sequence = Sequence::open(folder.path());
  REQUIRE(sequence.size() == 160);
  CHECK(sequence.entry(0).stamp == "1305031248.197746");
  const Frame frame = sequence.frame(159);
  CHECK(frame.color.type() == CV_8UC3);
  CHECK(frame.depth.type() == CV_16UC1);
  CHECK(cv::countNonZero(frame.depth) > 640 * 480 / 2);
}
