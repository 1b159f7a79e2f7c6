#include "stages/track/corners.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "stages/track/features.hpp"

namespace sediment::track {
namespace {

constexpr int kBorder_px = 19;       // the rotated 31 px patch of the descriptor fits
constexpr int kPatchRadius_px = 15;  // of the orientation
constexpr int kCell_px = 32;
constexpr int kClearThreshold = 20, kFaintThreshold = 7;  // FAST: grey values; ORB-SLAM's pair

// Half widths of the rows of the circular patch.
std::array<int, kPatchRadius_px + 1> circle_rows() {
  std::array<int, kPatchRadius_px + 1> half_width{};
  for (int row = 0; row <= kPatchRadius_px; ++row)
    half_width[row] = static_cast<int>(std::lround(std::sqrt(kPatchRadius_px * kPatchRadius_px - row * row)));
  return half_width;
}

// Angle of the intensity centroid (Rosin): moments over the circular patch.
float orientation_deg(const cv::Mat& level, int x, int y) {
  static const auto half_width = circle_rows();
  int moment_x = 0, moment_y = 0;
  for (int dy = -kPatchRadius_px; dy <= kPatchRadius_px; ++dy) {
    const int half = half_width[std::abs(dy)];
    const uchar* row = level.ptr<uchar>(y + dy) + x;
    int sum = 0;
    for (int dx = -half; dx <= half; ++dx) {
      sum += row[dx];
      moment_x += dx * row[dx];
    }
    moment_y += dy * sum;
  }
  return cv::fastAtan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

bool is_allowed(const cv::Mat& allowed, const cv::Point2f& level0) {
  if (allowed.empty()) return true;
  const int x = std::min(static_cast<int>(std::lround(level0.x)), allowed.cols - 1);
  const int y = std::min(static_cast<int>(std::lround(level0.y)), allowed.rows - 1);
  return allowed.at<uchar>(y, x) != 0;
}

using Cell = std::vector<cv::KeyPoint>;

// Corners of one level by grid cell, strongest first. A cell without a clear corner gets the faint ones.
std::vector<Cell> corners_by_cell(const cv::Mat& level, float scale, const cv::Mat& allowed) {
  const cv::Rect inside(kBorder_px, kBorder_px, level.cols - 2 * kBorder_px, level.rows - 2 * kBorder_px);
  if (inside.width < 8 || inside.height < 8) return {};
  const int columns = (inside.width + kCell_px - 1) / kCell_px,
            rows = (inside.height + kCell_px - 1) / kCell_px;
  std::vector<Cell> cells(static_cast<std::size_t>(columns) * rows);
  const auto add = [&](const std::vector<cv::KeyPoint>& corners, cv::Point offset) {
    for (cv::KeyPoint corner : corners) {
      corner.pt += cv::Point2f(offset);
      if (!inside.contains(cv::Point(corner.pt)) || !is_allowed(allowed, corner.pt * scale)) continue;
      const int column = (static_cast<int>(corner.pt.x) - kBorder_px) / kCell_px;
      const int row = (static_cast<int>(corner.pt.y) - kBorder_px) / kCell_px;
      cells[static_cast<std::size_t>(row) * columns + column].push_back(corner);
    }
  };
  std::vector<cv::KeyPoint> found;
  const cv::Rect with_ring(kBorder_px - 3, kBorder_px - 3, inside.width + 6, inside.height + 6);
  cv::FAST(level(with_ring), found, kClearThreshold, true);
  add(found, with_ring.tl());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      if (!cells[static_cast<std::size_t>(row) * columns + column].empty()) continue;
      const cv::Rect cell = cv::Rect(kBorder_px + column * kCell_px - 3, kBorder_px + row * kCell_px - 3,
                                     kCell_px + 6, kCell_px + 6) &
                            with_ring;
      if (cell.width < 7 || cell.height < 7) continue;
      cv::FAST(level(cell), found, kFaintThreshold, true);
      add(found, cell.tl());
    }
  for (Cell& cell : cells)
    std::sort(cell.begin(), cell.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
      if (a.response != b.response) return a.response > b.response;
      return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
    });
  return cells;
}

// The strongest of every cell, then the second of every cell, and so on: even over the image.
std::vector<cv::KeyPoint> best_of_cells(const std::vector<Cell>& cells, std::size_t wanted) {
  std::vector<cv::KeyPoint> chosen;
  for (std::size_t rank = 0; chosen.size() < wanted; ++rank) {
    std::vector<cv::KeyPoint> round;
    for (const Cell& cell : cells)
      if (rank < cell.size()) round.push_back(cell[rank]);
    if (round.empty()) break;
    std::stable_sort(round.begin(), round.end(),
                     [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
    round.resize(std::min(round.size(), wanted - chosen.size()));
    chosen.insert(chosen.end(), round.begin(), round.end());
  }
  return chosen;
}

}  // namespace

std::vector<cv::Mat> image_pyramid(const cv::Mat& gray) {
  std::vector<cv::Mat> pyramid{gray};
  for (int octave = 1; octave < kPyramidLevels; ++octave) {
    const cv::Size size(cvRound(gray.cols / kLevelScale[octave]), cvRound(gray.rows / kLevelScale[octave]));
    if (size.width < 2 || size.height < 2) break;
    cv::Mat level;
    cv::resize(pyramid.back(), level, size, 0, 0, cv::INTER_LINEAR);
    pyramid.push_back(level);
  }
  return pyramid;
}

std::vector<cv::KeyPoint> spread_corners(const std::vector<cv::Mat>& pyramid, const cv::Mat& allowed,
                                         int wanted) {
  // As many features per level as its area would have, in ORB-SLAM's way: by side length.
  const double ratio = 1.0 / kPyramidScale;
  double quota = wanted * (1 - ratio) / (1 - std::pow(ratio, kPyramidLevels));
  std::vector<cv::KeyPoint> corners;
  std::size_t missing = 0;  // what a poor level could not give goes to the next one
  for (std::size_t octave = 0; octave < pyramid.size(); ++octave, quota *= ratio) {
    const float scale = kLevelScale[octave];
    const std::size_t share = static_cast<std::size_t>(std::lround(quota)) + missing;
    auto chosen = best_of_cells(corners_by_cell(pyramid[octave], scale, allowed), share);
    missing = share - chosen.size();
    for (cv::KeyPoint& corner : chosen) {
      corner.angle =
          orientation_deg(pyramid[octave], static_cast<int>(corner.pt.x), static_cast<int>(corner.pt.y));
      corner.octave = static_cast<int>(octave);
      corner.size = (2 * kPatchRadius_px + 1) * scale;
      corner.pt *= scale;
      corners.push_back(corner);
    }
  }
  return corners;
}

}  // namespace sediment::track
