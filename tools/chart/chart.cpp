#include "tools/chart/chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace sediment::tools {
namespace {

const cv::Scalar kInk(60, 60, 60), kGrid(228, 228, 228), kPaper(255, 255, 255);
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kTextScale = 0.45;

struct Interval {
  double low = 0, high = 1;
  double length() const { return high - low; }
};

bool finite(const cv::Point2d& point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

Interval range_of(const Panel& panel, double cv::Point2d::*coordinate) {
  double low = INFINITY, high = -INFINITY;
  for (const Series& series : panel.series)
    for (const cv::Point2d& point : series.points) {
      if (!finite(point)) continue;
      low = std::min(low, point.*coordinate);
      high = std::max(high, point.*coordinate);
    }
  if (low > high) return {0, 1};
  if (high - low < 1e-9) return {low - 0.5, high + 0.5};
  return {low, high};
}

/// The part of the panel inside its axes, and the map from values to pixels.
struct Frame {
  cv::Rect area;
  Interval x, y;

  cv::Point2d pixel_of(const cv::Point2d& value) const {
    return {area.x + (value.x - x.low) / x.length() * area.width,
            area.y + area.height - (value.y - y.low) / y.length() * area.height};
  }
};

Frame frame_of(const Panel& panel, const cv::Rect& place) {
  Frame frame{{place.x + 74, place.y + 36, place.width - 74 - 20, place.height - 36 - 52},
              range_of(panel, &cv::Point2d::x),
              range_of(panel, &cv::Point2d::y)};
  if (panel.from_zero) frame.y.low = std::min(0.0, frame.y.low);
  const double margin_y = 0.05 * frame.y.length();
  if (!panel.from_zero) frame.y.low -= margin_y;
  frame.y.high += margin_y;
  if (!panel.equal_scale) return frame;
  const double per_px =
      std::max(frame.x.length() / frame.area.width, frame.y.length() / frame.area.height) * 1.05;
  for (const auto& [interval, pixels] :
       {std::pair{&frame.x, frame.area.width}, {&frame.y, frame.area.height}}) {
    const double middle = (interval->low + interval->high) / 2, half = per_px * pixels / 2;
    *interval = {middle - half, middle + half};
  }
  return frame;
}

/// Writes a text with its middle (0.5), left (0) or right end (1) at a point.
void write(cv::Mat& image, const std::string& text, cv::Point at, double anchor, double scale = kTextScale) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, kFont, scale, 1, &baseline);
  at.x -= static_cast<int>(anchor * size.width);
  cv::putText(image, text, at, kFont, scale, kInk, 1, cv::LINE_AA);
}

void draw_axes(cv::Mat& image, const Panel& panel, const Frame& frame) {
  char text[32];
  const auto label = [&](double value) {
    std::snprintf(text, sizeof text, "%.6g", std::abs(value) < 1e-12 ? 0.0 : value);
    return std::string(text);
  };
  const cv::Rect& area = frame.area;
  const double step_x = axis_step(frame.x.length(), 7), step_y = axis_step(frame.y.length(), 6);
  for (double x = std::ceil(frame.x.low / step_x) * step_x; x <= frame.x.high; x += step_x) {
    const int at = cvRound(frame.pixel_of({x, 0}).x);
    cv::line(image, {at, area.y}, {at, area.y + area.height}, kGrid);
    write(image, label(x), {at, area.y + area.height + 18}, 0.5);
  }
  for (double y = std::ceil(frame.y.low / step_y) * step_y; y <= frame.y.high; y += step_y) {
    const int at = cvRound(frame.pixel_of({0, y}).y);
    cv::line(image, {area.x, at}, {area.x + area.width, at}, kGrid);
    write(image, label(y), {area.x - 6, at + 5}, 1);
  }
  cv::rectangle(image, area, kInk);
  write(image, panel.title, {area.x + area.width / 2, area.y - 14}, 0.5, 0.55);
  write(image, panel.x_label, {area.x + area.width / 2, area.y + area.height + 40}, 0.5);
  write(image, panel.y_label, {area.x - 66, area.y - 14}, 0);
}

void draw_series(cv::Mat& image, const Series& series, const Frame& frame) {
  const cv::Scalar color(series.rgb[2], series.rgb[1], series.rgb[0]);
  constexpr int kShift = 4;  // fractions of a pixel
  const auto fixed = [&](const cv::Point2d& value) {
    const cv::Point2d at = frame.pixel_of(value);
    return cv::Point(cvRound(at.x * (1 << kShift)), cvRound(at.y * (1 << kShift)));
  };
  cv::Mat inside = image;  // lines end at the frame, as every point is in it
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    if (!finite(series.points[i])) continue;
    if (series.dots)
      cv::circle(inside, fixed(series.points[i]), 2 << kShift, color, cv::FILLED, cv::LINE_AA, kShift);
    else if (i > 0 && finite(series.points[i - 1]))
      cv::line(inside, fixed(series.points[i - 1]), fixed(series.points[i]), color, 1, cv::LINE_AA, kShift);
  }
}

void draw_legend(cv::Mat& image, const Panel& panel, const Frame& frame) {
  int row = frame.area.y + 16;
  for (const Series& series : panel.series) {
    if (series.name.empty()) continue;
    const cv::Scalar color(series.rgb[2], series.rgb[1], series.rgb[0]);
    int baseline = 0;
    const int right = frame.area.x + frame.area.width - 10;
    const int width = cv::getTextSize(series.name, kFont, kTextScale, 1, &baseline).width;
    cv::rectangle(image, cv::Rect(right - width - 34, row - 12, width + 38, 17), kPaper, cv::FILLED);
    cv::line(image, {right - width - 30, row - 4}, {right - width - 8, row - 4}, color, 2, cv::LINE_AA);
    write(image, series.name, {right, row}, 1);
    row += 18;
  }
}

}  // namespace

double axis_step(double range, int count) {
  const double rough = range / std::max(1, count);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double leading = rough / power;
  return power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
}

cv::Mat draw(const std::vector<Panel>& panels, cv::Size panel_size) {
  cv::Mat image(panel_size.height, panel_size.width * std::max(1, static_cast<int>(panels.size())), CV_8UC3,
                kPaper);
  int left = 0;
  for (const Panel& panel : panels) {
    const Frame frame = frame_of(panel, {left, 0, panel_size.width, panel_size.height});
    draw_axes(image, panel, frame);
    for (const Series& series : panel.series) draw_series(image, series, frame);
    draw_legend(image, panel, frame);
    left += panel_size.width;
  }
  return image;
}

}  // namespace sediment::tools
