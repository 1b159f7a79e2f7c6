#include "stages/interaction-mask/contact.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/stages/interaction-mask/random_scene.hpp"

using namespace sediment::interaction_mask;
using namespace sediment::test;

TEST_CASE("contact sums equal the double loop over all pixels on 1000 random scenes") {
  int with_pairs = 0, without_pairs = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const RandomScene scene = random_scene(seed);
    std::vector<int> dynamic, fixed;
    for (int id = 1; id <= scene.count; ++id) (id % 2 ? dynamic : fixed).push_back(id);
    for (const double radius_px : {6.0, 2.5}) {
      const auto sums = contact_sums(scene.ids, scene.depth, dynamic, fixed, radius_px);
      REQUIRE(sums.size() == dynamic.size() * fixed.size());
      auto sum = sums.begin();
      for (const int a : dynamic)
        for (const int b : fixed) {
          INFO("seed " << seed << ", pair " << a << " " << b << ", radius " << radius_px);
          REQUIRE(*sum == brute_force(scene.ids, scene.depth, a, b, radius_px));
          ++(sum++->pixel_pairs > 0 ? with_pairs : without_pairs);
        }
    }
  }
  // The scenes must show both outcomes, or the test above says little.
  CHECK(with_pairs > 1000);
  CHECK(without_pairs > 500);
}

TEST_CASE("a pair at exactly six pixels counts, one at (5, 4) does not") {
  cv::Mat ids(9, 9, CV_16UC1, cv::Scalar(0)), depth(9, 9, CV_16UC1, cv::Scalar(1000));
  ids.at<std::uint16_t>(0, 0) = 1;
  ids.at<std::uint16_t>(0, 6) = 2;
  ids.at<std::uint16_t>(4, 5) = 2;
  depth.at<std::uint16_t>(0, 6) = 1250;
  const auto sums = contact_sums(ids, depth, std::vector{1}, std::vector{2}, 6);
  CHECK(sums.at(0) == ContactSum{1, 250});
}

TEST_CASE("the sum of a large pair does not overflow") {
  // Two interleaved combs over a VGA image, depth differences of 65534: far beyond 32 bits.
  cv::Mat ids(480, 640, CV_16UC1), depth(480, 640, CV_16UC1);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      ids.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(1 + x % 2);
      depth.at<std::uint16_t>(y, x) = x % 2 ? 65535 : 1;
    }
  const ContactSum sum = contact_sums(ids, depth, std::vector{1}, std::vector{2}, 6).at(0);
  CHECK(sum.depth_difference == 65534 * sum.pixel_pairs);
  CHECK(sum.depth_difference > (1ULL << 36));
}

TEST_CASE("contact sums refuse images of other types and sizes and ids that no image can hold") {
  const cv::Mat ids(4, 4, CV_16UC1, cv::Scalar(1));
  const std::vector one{1}, two{2}, beyond{65536};
  CHECK_THROWS_AS(contact_sums(ids, cv::Mat(4, 4, CV_8UC1), one, two, 6), std::invalid_argument);
  CHECK_THROWS_AS(contact_sums(ids, cv::Mat(4, 5, CV_16UC1), one, two, 6), std::invalid_argument);
  CHECK_THROWS_AS(contact_sums(ids, ids, one, beyond, 6), std::invalid_argument);
}
