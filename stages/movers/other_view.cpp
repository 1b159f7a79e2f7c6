#include "stages/movers/other_view.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "stages/movers/regions.hpp"

namespace sediment::movers {
namespace {

/// Where in the grid of another view the pixels of a view lie if they stand still.
class Projection {
 public:
  Projection(const View& view, const View& there, const Camera& camera, const std::vector<Ray>& rays)
      : view_(view),
        camera_(camera),
        rays_(rays),
        there_from_here_(there.world_from_camera.inverse() * view.world_from_camera),
        cells_({}, cv::Size(there.depth.cols / kStep_px, there.depth.rows / kStep_px)) {}

  struct Place {
    cv::Point cell;
    double depth_m;
  };
  std::optional<Place> of(int column, int row) const {
    const cv::Point pixel = pixel_of({column, row});
    const double z = view_.depth.at<std::uint16_t>(pixel) / camera_.depth_scale;
    if (z <= 0) return std::nullopt;
    const Ray& ray = rays_[static_cast<std::size_t>(pixel.y) * camera_.width + pixel.x];
    const Vec3 point = there_from_here_ * Vec3{ray.x * z, ray.y * z, z};
    if (point.z <= 0) return std::nullopt;
    const Pixel at = camera_.project(point);
    const cv::Point cell(static_cast<int>(std::floor(at.u / kStep_px)),
                         static_cast<int>(std::floor(at.v / kStep_px)));
    if (!cells_.contains(cell)) return std::nullopt;
    return Place{cell, point.z};
  }

 private:
  const View& view_;
  const Camera& camera_;
  const std::vector<Ray>& rays_;
  Pose there_from_here_;
  cv::Rect cells_;
};

}  // namespace

cv::Mat confirmed_by(const cv::Mat& regions, const View& view, const cv::Mat& regions_there,
                     const View& there, const Camera& camera, const std::vector<Ray>& rays, int reach_px) {
  cv::Mat near, labels, known;
  const int reach = std::max(1, reach_px / kStep_px), side = 2 * reach + 1;
  cv::resize(there.dynamic, known, regions.size(), 0, 0, cv::INTER_NEAREST);
  known = (known != 0) | regions_there;
  cv::dilate(known, near, cv::Mat::ones(side, side, CV_8UC1));
  const int count = cv::connectedComponents(regions, labels, 8);
  std::vector<int> all(static_cast<std::size_t>(count)), shown(all.size());
  const Projection projection(view, there, camera, rays);
  for (int y = 0; y < regions.rows; ++y)
    for (int x = 0; x < regions.cols; ++x) {
      const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
      if (label == 0) continue;
      const auto place = projection.of(x, y);
      if (!place) continue;
      ++all[label];
      shown[label] += near.at<std::uint8_t>(place->cell) ? 1 : 0;
    }
  cv::Mat confirmed(regions.size(), CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < regions.rows; ++y)
    for (int x = 0; x < regions.cols; ++x) {
      const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
      if (label > 0 && all[label] > 0 && 2 * shown[label] >= all[label])
        confirmed.at<std::uint8_t>(y, x) = 255;
    }
  return confirmed;
}

cv::Mat carried_from(const cv::Mat& regions_there, const View& there, const View& view, const Camera& camera,
                     const std::vector<Ray>& rays) {
  cv::Mat carried(regions_there.size(), CV_8UC1, cv::Scalar(0));
  if (cv::countNonZero(regions_there) == 0) return carried;
  const Projection projection(view, there, camera, rays);
  for (int y = 0; y < carried.rows; ++y)
    for (int x = 0; x < carried.cols; ++x) {
      const auto place = projection.of(x, y);
      if (!place || !regions_there.at<std::uint8_t>(place->cell)) continue;
      const double depth_m = there.depth.at<std::uint16_t>(pixel_of(place->cell)) / camera.depth_scale;
      if (goes_on(place->depth_m, depth_m)) carried.at<std::uint8_t>(y, x) = 255;
    }
  return carried;
}

}  // namespace sediment::movers
