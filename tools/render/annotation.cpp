#include "tools/render/annotation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace sediment::render {
namespace {

constexpr int kMargin_px = 22;
constexpr int kLine_px = 24;
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kFontScale = 0.5;
const cv::Scalar kInk(40, 40, 40);

/// Lets the picture show through a panel of paper.
void add_panel(cv::Mat& picture, cv::Rect panel) {
  panel &= cv::Rect({0, 0}, picture.size());
  if (panel.empty()) return;
  cv::Mat part = picture(panel);
  cv::addWeighted(part, 0.22, cv::Mat(part.size(), part.type(), cv::Scalar(255, 255, 255)), 0.78, 0, part);
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// The largest of 1, 2, 5 times a power of ten that is not above `length`.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= length) return factor * power;
  return power;
}

}  // namespace

cv::Size text_size(const std::string& text, double size) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, kFontScale * size, 1, &baseline);
}

void write_text(cv::Mat& picture, const std::string& text, cv::Point at, double size, cv::Scalar bgr) {
  const int thickness = size > 1.3 ? 2 : 1;
  cv::putText(picture, text, at, kFont, kFontScale * size, cv::Scalar(255, 255, 255), thickness + 2,
              cv::LINE_AA);
  cv::putText(picture, text, at, kFont, kFontScale * size, bgr, thickness, cv::LINE_AA);
}

void add_title(cv::Mat& picture, const std::string& title) {
  if (!title.empty()) write_text(picture, title, {kMargin_px, kMargin_px + 12}, 1.25, kInk);
}

void add_scale_bar(cv::Mat& picture, double px_per_metre) {
  const double length_m = round_length(0.22 * picture.cols / px_per_metre);
  const int length_px = static_cast<int>(std::lround(length_m * px_per_metre));
  const int left = kMargin_px, bottom = picture.rows - kMargin_px;
  add_panel(picture, {left - 10, bottom - 34, length_px + 20, 44});
  cv::rectangle(picture, cv::Point(left, bottom - 6), cv::Point(left + length_px, bottom), kInk, cv::FILLED);
  cv::rectangle(picture, cv::Point(left + length_px / 2, bottom - 5),
                cv::Point(left + length_px - 1, bottom - 1), cv::Scalar(255, 255, 255), cv::FILLED);
  write_text(picture, length_m < 1 ? text_of(100 * length_m) + " cm" : text_of(length_m) + " m",
             {left, bottom - 14});
}

void add_legend(cv::Mat& picture, const std::vector<LegendEntry>& entries) {
  if (entries.empty()) return;
  const auto fitting = static_cast<std::size_t>(std::max(1, (picture.rows - kMargin_px) / kLine_px));
  const std::size_t shown = std::min(entries.size(), fitting);
  int width = 0;
  for (std::size_t i = 0; i < shown; ++i) width = std::max(width, text_size(entries[i].text).width);
  const int left = picture.cols - kMargin_px - width - 26;
  add_panel(picture, {left - 12, kMargin_px - 8, width + 46, static_cast<int>(shown) * kLine_px + 12});
  for (std::size_t i = 0; i < shown; ++i) {
    const int top = kMargin_px + static_cast<int>(i) * kLine_px;
    cv::rectangle(picture, cv::Rect(left, top, 16, 16), cv::Scalar(entries[i].bgr), cv::FILLED, cv::LINE_AA);
    cv::rectangle(picture, cv::Rect(left, top, 16, 16), cv::Scalar(120, 120, 120), 1, cv::LINE_AA);
    write_text(picture, entries[i].text, {left + 26, top + 13});
  }
}

void add_height_scale(cv::Mat& picture, const HeightRange& range, const std::string& unit) {
  const int height = std::min(220, picture.rows / 3), width = 16;
  const int left = picture.cols - kMargin_px - 76, top = picture.rows - kMargin_px - height;
  add_panel(picture, {left - 12, top - 16, 100, height + 32});
  for (int row = 0; row < height; ++row)
    cv::line(picture, cv::Point(left, top + row), cv::Point(left + width, top + row),
             cv::Scalar(scale_color(1 - row / (height - 1.0))));
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const int y = top + static_cast<int>((1 - share) * (height - 1));
    char text[32];
    std::snprintf(text, sizeof text, std::abs(range.high_m) < 10 ? "%.2f %s" : "%.0f %s",
                  range.low_m + share * (range.high_m - range.low_m), unit.c_str());
    cv::line(picture, cv::Point(left + width, y), cv::Point(left + width + 4, y), kInk);
    write_text(picture, text, {left + width + 9, y + 5}, 0.85);
  }
}

}  // namespace sediment::render
