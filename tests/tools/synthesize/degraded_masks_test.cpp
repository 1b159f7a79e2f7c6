#include "tools/synthesize/degraded_masks.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using namespace sediment::synthetic;

TEST_CASE("thirty per cent of the frames are missed, in runs of up to ten") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<bool> missed = missed_frames(300, {}, seed);
    CHECK(std::count(missed.begin(), missed.end(), true) == 90);
    int run = 0, longest = 0, runs = 0;
    for (const bool m : missed) {
      runs += m && run == 0;
      run = m ? run + 1 : 0;
      longest = std::max(longest, run);
    }
    CHECK(longest <= 10);
    CHECK(longest >= 6);
    CHECK(runs < 45);
  }
  CHECK(missed_frames(1, {}, 1).size() == 1);
  CHECK(missed_frames(0, {}, 1).empty());
}

TEST_CASE("degraded masks stay within six pixels of the truth, and some classes are wrong") {
  const test::SyntheticSequence s =
      test::synthetic_sequence({.frames = 12, .width = 320, .height = 240, .degraded = true, .rate_hz = 2});
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {13, 13});
  int instances = 0, wrong = 0, empty_frames = 0, grown = 0, shrunk = 0;
  for (std::size_t i = 0; i < s.frames.size(); ++i) {
    empty_frames += s.degraded[i].instances.empty();
    for (const Instance& found : s.degraded[i].instances) {
      const auto same = [&](const Instance& other) { return other.id == found.id; };
      const auto truth = std::find_if(s.instances[i].instances.begin(), s.instances[i].instances.end(), same);
      REQUIRE(truth != s.instances[i].instances.end());
      ++instances;
      wrong += truth->class_name != found.class_name;
      cv::Mat reach, pixels = s.degraded[i].ids == found.id;
      cv::dilate(s.instances[i].ids == found.id, reach, disc);
      CHECK(cv::countNonZero(pixels & ~reach) == 0);
      CHECK(cv::countNonZero(pixels) > 0);
      CHECK(found.score >= 0.35);
      CHECK(found.score <= 0.95);
      const int before = cv::countNonZero(s.instances[i].ids == found.id), after = cv::countNonZero(pixels);
      grown += after > before, shrunk += after < before;
    }
  }
  CHECK(empty_frames == 4);
  CHECK(instances > 80);
  CHECK(grown > instances / 5);
  CHECK(shrunk > instances / 5);
  CHECK(wrong > 0);
  CHECK(wrong < instances / 7);
}
