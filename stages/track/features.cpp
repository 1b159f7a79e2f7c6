#include "stages/track/features.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "stages/track/corners.hpp"

namespace sediment::track {
namespace {

constexpr int kCell_px = 16;

std::array<float, kPyramidLevels> level_scales() {
  std::array<float, kPyramidLevels> scales{1};
  for (int octave = 1; octave < kPyramidLevels; ++octave) scales[octave] = scales[octave - 1] * kPyramidScale;
  return scales;
}

std::vector<Descriptor> describe(const cv::Mat& gray, std::vector<cv::KeyPoint>& corners) {
  // The edge is checked level by level in spread_corners already.
  const auto orb = cv::ORB::create(1, kPyramidScale, kPyramidLevels, 0, 0, 2, cv::ORB::FAST_SCORE, 31);
  cv::Mat rows;
  orb->compute(gray, corners, rows);
  std::vector<Descriptor> descriptors(static_cast<std::size_t>(rows.rows));
  for (int row = 0; row < rows.rows; ++row)
    std::memcpy(descriptors[row].data(), rows.ptr(row), sizeof(Descriptor));
  return descriptors;
}

}  // namespace

const std::array<float, kPyramidLevels> kLevelScale = level_scales();

FrameFeatures::FrameFeatures(std::vector<Feature> features,
                             std::shared_ptr<const std::vector<Descriptor>> descriptors, int width,
                             int height)
    : features_(std::move(features)),
      descriptors_(std::move(descriptors)),
      columns_((width + kCell_px - 1) / kCell_px),
      rows_((height + kCell_px - 1) / kCell_px) {
  fill_grid();
}

void FrameFeatures::fill_grid() {
  cell_start_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  std::vector<int> cells;
  for (const Feature& feature : features_) {
    cells.push_back(cell_of(feature.v_px, rows_) * columns_ + cell_of(feature.u_px, columns_));
    ++cell_start_[static_cast<std::size_t>(cells.back()) + 1];
  }
  for (std::size_t cell = 1; cell < cell_start_.size(); ++cell) cell_start_[cell] += cell_start_[cell - 1];
  cell_features_.resize(features_.size());
  std::vector<int> next = cell_start_;
  for (std::size_t feature_idx = 0; feature_idx < cells.size(); ++feature_idx)
    cell_features_[next[cells[feature_idx]]++] = static_cast<int>(feature_idx);
}

FrameFeatures FrameFeatures::joined(const FrameFeatures& more) const {
  FrameFeatures all;
  all.columns_ = columns_;
  all.rows_ = rows_;
  all.features_ = features_;
  all.features_.insert(all.features_.end(), more.features_.begin(), more.features_.end());
  auto descriptors = std::make_shared<std::vector<Descriptor>>(*descriptors_);
  descriptors->insert(descriptors->end(), more.descriptors_->begin(), more.descriptors_->end());
  all.descriptors_ = std::move(descriptors);
  all.fill_grid();
  return all;
}

int FrameFeatures::cell_of(float position_px, int cells) const {
  return std::clamp(static_cast<int>(std::floor(position_px / kCell_px)), 0, cells - 1);
}

void FrameFeatures::find_near(float u_px, float v_px, float radius_px, int min_octave, int max_octave,
                              std::vector<int>& found) const {
  found.clear();
  if (features_.empty()) return;
  const int left = cell_of(u_px - radius_px, columns_), right = cell_of(u_px + radius_px, columns_);
  const int top = cell_of(v_px - radius_px, rows_), bottom = cell_of(v_px + radius_px, rows_);
  for (int row = top; row <= bottom; ++row)
    for (int i = cell_start_[row * columns_ + left]; i < cell_start_[row * columns_ + right + 1]; ++i) {
      const Feature& feature = features_[cell_features_[i]];
      if (feature.octave < min_octave || feature.octave > max_octave) continue;
      if (std::abs(feature.u_px - u_px) < radius_px && std::abs(feature.v_px - v_px) < radius_px)
        found.push_back(cell_features_[i]);
    }
}

cv::Mat allowed_pixels(const cv::Mat& dynamic_mask, int halo_px) {
  if (dynamic_mask.empty()) return {};
  cv::Mat dynamic = dynamic_mask != 0, grown;
  const cv::Size size(2 * halo_px + 1, 2 * halo_px + 1);
  cv::dilate(dynamic, grown, cv::getStructuringElement(cv::MORPH_RECT, size));
  return 255 - grown;
}

FrameFeatures find_features(const cv::Mat& gray, const cv::Mat& allowed, const Camera& camera, int wanted) {
  std::vector<cv::KeyPoint> corners = spread_corners(image_pyramid(gray), allowed, wanted);
  auto descriptors = std::make_shared<const std::vector<Descriptor>>(describe(gray, corners));
  std::vector<Feature> features;
  features.reserve(corners.size());
  for (const cv::KeyPoint& corner : corners) {
    const Pixel ray = camera.undistort({corner.pt.x, corner.pt.y});
    Feature feature;
    feature.u_px = feature.seen_u_px = static_cast<float>(camera.fx * ray.u + camera.cx);
    feature.v_px = feature.seen_v_px = static_cast<float>(camera.fy * ray.v + camera.cy);
    feature.row = corner.pt.y / static_cast<float>(camera.height) - 0.5f;
    feature.angle_deg = corner.angle;
    feature.octave = corner.octave;
    features.push_back(feature);
  }
  return FrameFeatures(std::move(features), std::move(descriptors), camera.width, camera.height);
}

}  // namespace sediment::track
