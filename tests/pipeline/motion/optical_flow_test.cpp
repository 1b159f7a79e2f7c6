#include "pipeline/motion/optical_flow.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/pipeline/motion/textured.hpp"

using namespace sediment;

TEST_CASE("flow finds how far a picture was shifted, in pixels of the full image, at any image size") {
  const cv::Size size =
      GENERATE(cv::Size(64, 48), cv::Size(640, 480), cv::Size(641, 479), cv::Size(1280, 720));
  // Texture as coarse as the grid the flow is computed on.
  cv::Mat wide;
  const int factor = std::max(1, size.width / 320);
  cv::resize(test::texture({(size.width + 40) / factor, (size.height + 40) / factor}, 3), wide,
             {size.width + 40, size.height + 40}, 0, 0, cv::INTER_CUBIC);
  const cv::Point shift(6, -4);
  const cv::Mat from = wide(cv::Rect({20, 20}, size)), to = wide(cv::Rect(cv::Point(20, 20) - shift, size));
  const FlowField flow = flow_between(flow_image(from), flow_image(to), size);
  double worst = 0, sum = 0;
  int count = 0;
  for (int v = 12; v < size.height - 12; v += 3)
    for (int u = 12; u < size.width - 12; u += 3, ++count) {
      const double error =
          cv::norm(flow.at(static_cast<float>(u), static_cast<float>(v)) - cv::Point2f(shift));
      worst = std::max(worst, error);
      sum += error;
    }
  CHECK(sum / count < 0.5);
  CHECK(worst < 4);
}

TEST_CASE("flows are computed by many threads at once") {
  // Small ones, so that threads meet often where OpenCV's state is shared.
  const cv::Mat from = flow_image(test::texture({16, 16}, 1)), to = flow_image(test::texture({16, 16}, 2));
  const cv::Point2f expected = flow_between(from, to, from.size()).at(8, 8);
  std::atomic<int> others = 0;
  std::vector<std::jthread> threads(8);
  for (std::jthread& thread : threads)
    thread = std::jthread([&] {
      for (int i = 0; i < 2000; ++i) others += flow_between(from, to, from.size()).at(8, 8) != expected;
    });
  threads.clear();
  CHECK(others == 0);
}

TEST_CASE("flow is the same at any number of OpenCV's threads") {
  const cv::Mat from = flow_image(test::texture({320, 240}, 1)),
                to = flow_image(test::texture({320, 240}, 2));
  const auto sample = [&](int threads) {
    cv::setNumThreads(threads);
    const FlowField flow = flow_between(from, to, {320, 240});
    std::vector<cv::Point2f> samples;
    for (int i = 0; i < 240; ++i) samples.push_back(flow.at(static_cast<float>(i), static_cast<float>(i)));
    return samples;
  };
  CHECK(sample(1) == sample(4));
}

TEST_CASE("a displacement is mutual if the way back leads to the start") {
  CHECK(is_mutual({10, 5}, {-10, -5}));
  CHECK(is_mutual({10, 5}, {-9, -4.5F}));
  CHECK_FALSE(is_mutual({10, 5}, {0, 0}));
  CHECK(is_mutual({0, 0}, {1, 0}));
}

TEST_CASE("flow refuses images of two sizes and tiny ones") {
  const cv::Mat image(48, 64, CV_8UC1, cv::Scalar(0));
  CHECK_THROWS_AS(flow_between(image, cv::Mat(48, 60, CV_8UC1, cv::Scalar(0)), {64, 48}),
                  std::invalid_argument);
  CHECK_THROWS_AS(flow_between(image(cv::Rect(0, 0, 64, 8)), image(cv::Rect(0, 0, 64, 8)), {64, 8}),
                  std::invalid_argument);
}

TEST_CASE("the flow at many positions is that at each of them, to the bit, outside the image too") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> displacement(-30, 30), along(-20, 180);
  cv::Mat displacements(60, 80, CV_32FC2);
  for (auto& d : cv::Mat_<cv::Point2f>(displacements)) d = {displacement(random), displacement(random)};
  const FlowField flow(displacements, {160, 120});
  std::vector<float> u(1001), v(1001), du(1001), dv(1001);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = along(random), v[i] = along(random);
  flow.at_each(u.data(), v.data(), u.size(), du.data(), dv.data());
  for (std::size_t i = 0; i < u.size(); ++i) REQUIRE(flow.at(u[i], v[i]) == cv::Point2f(du[i], dv[i]));
}
