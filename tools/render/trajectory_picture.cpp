#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "tools/render/annotation.hpp"
#include "tools/render/pictures.hpp"

namespace sediment::render {
namespace {

Trajectory read(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) ? read_trajectory(path) : read_tum_trajectory(path);
}

std::vector<Vec3> positions_of(const Trajectory& trajectory) {
  std::vector<Vec3> positions;
  for (const StampedPose& pose : trajectory) positions.push_back(pose.world_from_camera.translation);
  return positions;
}

std::vector<double> stamps_of(const Trajectory& trajectory) {
  std::vector<double> stamps_s;
  for (const StampedPose& pose : trajectory) stamps_s.push_back(pose.stamp_s);
  return stamps_s;
}

struct Compared {
  std::vector<Vec3> estimate;    ///< in the frame of the truth
  std::vector<double> errors_m;  ///< of each estimate; NaN where no truth belongs to it
  double rmse_m = 0;
  std::size_t pairs = 0;
};

/// Rigid alignment without scale of the positions that belong together, as TUM's evaluate_ate.py.
Compared compare(const Trajectory& truth, const Trajectory& estimate, double tolerance_s) {
  const auto pairs = associate(stamps_of(truth), stamps_of(estimate), tolerance_s);
  if (pairs.size() < 3)
    throw std::runtime_error("only " + std::to_string(pairs.size()) +
                             " poses of truth and estimate are within " + std::to_string(tolerance_s) +
                             " s of each other");
  const std::vector<Vec3> from = positions_of(estimate), to = positions_of(truth);
  Eigen::Matrix3Xd source(3, pairs.size()), target(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Vec3 a = from[pairs[i].second], b = to[pairs[i].first];
    source.col(static_cast<Eigen::Index>(i)) << a.x, a.y, a.z;
    target.col(static_cast<Eigen::Index>(i)) << b.x, b.y, b.z;
  }
  const Eigen::Matrix4d aligned = Eigen::umeyama(source, target, false);
  Compared compared{{}, std::vector<double>(from.size(), NAN), 0, pairs.size()};
  for (const Vec3 p : from) {
    const Eigen::Vector4d q = aligned * Eigen::Vector4d(p.x, p.y, p.z, 1);
    compared.estimate.push_back({q.x(), q.y(), q.z()});
  }
  for (const auto& [truth_idx, idx] : pairs) {
    compared.errors_m[idx] = norm(compared.estimate[idx] - to[truth_idx]);
    compared.rmse_m += compared.errors_m[idx] * compared.errors_m[idx] / static_cast<double>(pairs.size());
  }
  compared.rmse_m = std::sqrt(compared.rmse_m);
  return compared;
}

cv::Point2d pixel_of(const View& view, Vec3 p) {
  const auto at = view.project(p);
  return {at->u, at->v};
}

void draw_path(cv::Mat& picture, const View& view, const std::vector<Vec3>& path,
               const std::vector<cv::Scalar>& colors, int width) {
  constexpr int kShift = 4;  // sixteenths of a pixel
  const auto fixed = [&](Vec3 p) {
    const cv::Point2d at = pixel_of(view, p) * (1 << kShift);
    return cv::Point(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
  };
  for (std::size_t i = 1; i < path.size(); ++i)
    cv::line(picture, fixed(path[i - 1]), fixed(path[i]), colors[i], width, cv::LINE_AA, kShift);
}

void mark(cv::Mat& picture, const View& view, Vec3 at, const std::string& text) {
  const cv::Point2d p = pixel_of(view, at);
  cv::circle(picture, p, 6, cv::Scalar(255, 255, 255), cv::FILLED, cv::LINE_AA);
  cv::circle(picture, p, 6, cv::Scalar(40, 40, 40), 2, cv::LINE_AA);
  write_text(picture, text, {static_cast<int>(p.x) + 11, static_cast<int>(p.y) - 7});
}

}  // namespace

cv::Mat trajectory_picture(const TrajectoryOptions& options) {
  const Trajectory estimate = read(options.estimate);
  const Trajectory truth = options.truth.empty() ? Trajectory{} : read(options.truth);
  if (estimate.empty()) throw std::runtime_error(options.estimate.string() + ": no poses");
  Compared compared{positions_of(estimate), {}, 0, 0};
  if (!truth.empty()) compared = compare(truth, estimate, options.tolerance_s);

  // The part of the truth that the estimate covers.
  std::vector<Vec3> truth_path;
  for (const StampedPose& pose : truth)
    if (pose.stamp_s >= estimate.front().stamp_s - options.tolerance_s &&
        pose.stamp_s <= estimate.back().stamp_s + options.tolerance_s)
      truth_path.push_back(pose.world_from_camera.translation);

  ViewOptions view_options;
  view_options.direction = Direction::top;
  view_options.size = options.size;
  view_options.zoom = 0.85;
  std::vector<Vec3> all = compared.estimate;
  all.insert(all.end(), truth_path.begin(), truth_path.end());
  const View view = fit_view(
      all, map_from_world("", options.up.empty() && !truth.empty() ? "0 0 1" : options.up), view_options);

  cv::Mat picture(options.size, CV_8UC3, cv::Scalar(250, 250, 250));
  draw_path(picture, view, truth_path, std::vector<cv::Scalar>(truth_path.size(), cv::Scalar(165, 165, 165)),
            5);
  HeightRange range{0, 0.01};
  for (const double error_m : compared.errors_m)
    if (std::isfinite(error_m)) range.high_m = std::max(range.high_m, error_m);
  std::vector<cv::Scalar> colors(compared.estimate.size(), cv::Scalar(180, 90, 20));
  for (std::size_t i = 0; i < compared.errors_m.size(); ++i)
    if (std::isfinite(compared.errors_m[i]))
      colors[i] = cv::Scalar(scale_color(0.12 + 0.8 * range.share(compared.errors_m[i])));
  draw_path(picture, view, compared.estimate, colors, 2);
  mark(picture, view, compared.estimate.front(), "start");
  mark(picture, view, compared.estimate.back(), "end");

  add_title(picture, options.title);
  add_scale_bar(picture, view.scale);
  if (truth.empty()) return picture;
  char text[96];
  std::snprintf(text, sizeof text, "ATE %.1f mm (rmse of %zu poses, aligned rigidly)", 1000 * compared.rmse_m,
                compared.pairs);
  write_text(picture, text, {22, options.title.empty() ? 34 : 62});
  add_legend(picture, {{{165, 165, 165}, "truth"}, {scale_color(0.5), "estimate, coloured by error"}});
  add_height_scale(picture, {0, 1000 * range.high_m}, "mm");
  return picture;
}

}  // namespace sediment::render
