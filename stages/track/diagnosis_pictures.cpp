#include "stages/track/diagnosis_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "pipeline/scene/dynamic_picture.hpp"

namespace sediment::track {
namespace {

const cv::Scalar kHeldBgr(60, 220, 60), kOtherBgr(170, 170, 170);
const cv::Scalar kInk(40, 40, 40), kBar(200, 150, 90), kCurve(40, 40, 200);
constexpr int kBins = 60, kLeft = 20, kBottom = 40, kTop = 40;
const cv::Size kPanel(kBins * 10 + 2 * kLeft, 360);

void write(cv::Mat image, const std::string& text, cv::Point at) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.45, kInk, 1, cv::LINE_AA);
}

/// Shares of the values a bin from `low` to `high`; what is beyond is in the outermost bins.
std::vector<double> shares_of(const std::vector<float>& values, double low, double high) {
  std::vector<double> shares(kBins, 0);
  for (const float value : values) {
    const double bin = std::floor((static_cast<double>(value) - low) / (high - low) * kBins);
    shares[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))] +=
        1.0 / static_cast<double>(values.size());
  }
  return shares;
}

cv::Mat histogram(const std::vector<float>& values, double low, double high, const std::string& title,
                  const std::vector<double>& expected) {
  cv::Mat panel(kPanel, CV_8UC3, cv::Scalar::all(255));
  const auto shares = shares_of(values, low, high);
  double highest = *std::max_element(shares.begin(), shares.end());
  for (const double share : expected) highest = std::max(highest, share);
  const int floor_row = kPanel.height - kBottom, height = floor_row - kTop;
  const auto row_of = [&](double share) {
    return floor_row - static_cast<int>(std::lround(share / std::max(highest, 1e-9) * height));
  };
  for (int bin = 0; bin < kBins; ++bin)
    cv::rectangle(panel, {kLeft + bin * 10, row_of(shares[static_cast<std::size_t>(bin)])},
                  {kLeft + bin * 10 + 8, floor_row}, kBar, cv::FILLED);
  for (int bin = 1; bin < static_cast<int>(expected.size()); ++bin)
    cv::line(panel, {kLeft + bin * 10 - 5, row_of(expected[static_cast<std::size_t>(bin) - 1])},
             {kLeft + bin * 10 + 5, row_of(expected[static_cast<std::size_t>(bin)])}, kCurve, 1, cv::LINE_AA);
  for (int tick = 0; tick <= 6; ++tick) {
    const double value = low + (high - low) * tick / 6;
    cv::line(panel, {kLeft + tick * 100, floor_row}, {kLeft + tick * 100, floor_row + 5}, kInk);
    write(panel, cv::format("%g", value), {kLeft + tick * 100 - 8, floor_row + 22});
  }
  write(panel, title, {kLeft, 22});
  return panel;
}

}  // namespace

cv::Mat features_picture(const cv::Mat& color, const cv::Mat& dynamic, const KeyframeFeatures& keyframe) {
  cv::Mat picture = color.clone();
  if (!dynamic.empty())
    for (const DynamicValue value : {kPriorDynamic, kNonPriorDynamic}) tint_dynamic(picture, dynamic, value);
  for (const bool held : {false, true})
    for (const ShownFeature& feature : keyframe.features)
      if (feature.held == held)
        cv::circle(picture, {cvRound(feature.u_px), cvRound(feature.v_px)}, held ? 3 : 2,
                   held ? kHeldBgr : kOtherBgr, 1, cv::LINE_AA);
  return picture;
}

cv::Mat residuals_picture(const Diagnosis& diagnosis) {
  constexpr double kFarthest_px = 3, kFarthest = 4.5;
  std::vector<double> normal;
  for (int bin = 0; bin < kBins; ++bin) {
    const double width = 2 * kFarthest / kBins, x = -kFarthest + (bin + 0.5) * width;
    normal.push_back(width * std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi));
  }
  cv::Mat both;
  cv::hconcat(
      histogram(diagnosis.error_px, 0, kFarthest_px, "reprojection error of sightings in keyframes [px]", {}),
      histogram(diagnosis.depth_error, -kFarthest, kFarthest,
                "error of inverse depth [standard deviations]; line: normal", normal),
      both);
  return both;
}

}  // namespace sediment::track
