#include <catch2/catch.hpp>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using namespace sediment::test;

TEST_CASE("a written sequence reads back as it was in memory, with its truth") {
  const TemporaryFolder folder;
  const SyntheticSettings settings{.frames = 4, .rate_hz = 2};
  const SyntheticSequence truth = synthetic_sequence(settings);
  const Sequence sequence = Sequence::open(write_synthetic_sequence(folder.path(), settings));

  REQUIRE(sequence.size() == 4);
  CHECK(sequence.camera().fx == Approx(truth.camera.fx).epsilon(1e-9));
  const Trajectory poses = read_tum_trajectory(folder / "groundtruth.txt");
  const MasksReader masks(folder / "truth/instances");
  const DynamicMasksReader dynamic(folder / "truth/dynamic");
  for (std::size_t i = 0; i < 4; ++i) {
    const Frame frame = sequence.frame(i);
    CHECK(frame.stamp == truth.frames[i].stamp);
    CHECK(cv::norm(frame.color, truth.frames[i].color, cv::NORM_INF) == 0);
    CHECK(cv::norm(frame.depth, truth.frames[i].depth, cv::NORM_INF) == 0);
    CHECK(cv::norm(masks.read(frame.stamp).ids, truth.instances[i].ids, cv::NORM_INF) == 0);
    CHECK(cv::norm(dynamic.read(frame.stamp), truth.dynamic[i], cv::NORM_INF) == 0);
    CHECK(norm(poses.at(i).world_from_camera.translation -
               truth.groundtruth[i].world_from_camera.translation) < 1e-8);
  }
  CHECK(read_cloud(folder / "truth/static_cloud") == truth.static_cloud);
}
