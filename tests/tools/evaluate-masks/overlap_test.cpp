#include "tools/evaluate-masks/overlap.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace sediment;
using namespace sediment::tools;

namespace {

cv::Mat blank(int width = 64, int height = 48) {
  return cv::Mat(height, width, CV_8UC1, cv::Scalar(0));
}

cv::Mat with_box(cv::Rect box) {
  cv::Mat mask = blank();
  mask(box).setTo(1);
  return mask;
}

/// The definition, pixel by pixel.
std::optional<double> boundary_f_by_hand(const cv::Mat& truth, const cv::Mat& mask, int radius) {
  const auto boundary = [](const cv::Mat& m) {
    std::vector<cv::Point> points;
    for (int y = 0; y < m.rows; ++y)
      for (int x = 0; x < m.cols; ++x) {
        const auto outside = [&](int nx, int ny) {
          return nx >= 0 && ny >= 0 && nx < m.cols && ny < m.rows && m.at<std::uint8_t>(ny, nx) == 0;
        };
        if (m.at<std::uint8_t>(y, x) != 0 &&
            (outside(x - 1, y) || outside(x + 1, y) || outside(x, y - 1) || outside(x, y + 1)))
          points.emplace_back(x, y);
      }
    return points;
  };
  const auto a = boundary(truth), b = boundary(mask);
  if (a.empty() && b.empty()) return std::nullopt;
  if (a.empty() || b.empty()) return 0;
  const auto near = [&](const auto& from, const auto& to) {
    double count = 0;
    for (const cv::Point& p : from)
      for (const cv::Point& q : to)
        if ((p - q).dot(p - q) <= radius * radius) {
          ++count;
          break;
        }
    return count / static_cast<double>(from.size());
  };
  const double precision = near(b, a), recall = near(a, b);
  return precision + recall == 0 ? 0 : 2 * precision * recall / (precision + recall);
}

}  // namespace

TEST_CASE("overlap counts every pixel once") {
  const Overlap overlap = overlap_of(with_box({10, 10, 20, 10}), with_box({20, 10, 20, 10}));
  CHECK(overlap.hit == 100);
  CHECK(overlap.missed == 100);
  CHECK(overlap.extra == 100);
  CHECK(overlap.pixels() == 64 * 48);
  CHECK(overlap.iou() == Approx(1.0 / 3));
  CHECK(overlap.precision() == 0.5);
  CHECK(overlap.recall() == 0.5);
}

TEST_CASE("what has nothing to be divided by has no value") {
  const Overlap nothing = overlap_of(blank(), blank());
  CHECK_FALSE(nothing.iou());
  CHECK_FALSE(nothing.precision());
  CHECK_FALSE(nothing.recall());
  CHECK(overlap_of(blank(), with_box({0, 0, 2, 2})).precision() == 0);
}

TEST_CASE("the boundary measure is its definition, for boxes and for noise") {
  const cv::Mat truth = with_box({10, 10, 20, 15});
  CHECK(boundary_f(truth, truth, 2) == 1);
  CHECK(boundary_f(truth, with_box({12, 10, 20, 15}), 2) == 1);
  CHECK(boundary_f(truth, with_box({40, 30, 20, 15}), 2) == 0);
  CHECK_FALSE(boundary_f(blank(), blank(), 2));
  CHECK(boundary_f(blank(), truth, 2) == 0);
  CHECK_FALSE(boundary_f(with_box({0, 0, 64, 48}), blank(), 2));  // a whole image has no boundary
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    cv::Mat a = blank(24, 18), b = blank(24, 18);
    for (int i = 0; i < 24 * 18; ++i) {
      a.data[i] = random() % 3 == 0;
      b.data[i] = random() % 6 == 0;
    }
    const int radius = round % 4;
    CHECK(boundary_f(a, b, radius).value() == Approx(boundary_f_by_hand(a, b, radius).value()));
  }
}

TEST_CASE("the radius is DAVIS's share of the diagonal") {
  CHECK(boundary_radius_px({640, 480}) == 7);
  CHECK(boundary_radius_px({854, 480}) == 8);
}
