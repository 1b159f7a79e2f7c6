#include "tools/evaluate-trajectory/evaluation_plot.hpp"

#include <algorithm>
#include <cmath>

#include "tools/chart/chart.hpp"

namespace sediment::tools {
namespace {

constexpr std::array<std::uint8_t, 3> kTruth{40, 40, 40}, kEstimate{25, 90, 200}, kError{215, 60, 45};

double along(Vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// The two axes in which the positions extend most, in their order.
std::array<int, 2> widest_axes(const std::vector<Vec3>& positions) {
  std::array<std::pair<double, int>, 3> extents;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        positions.begin(), positions.end(), [&](Vec3 a, Vec3 b) { return along(a, axis) < along(b, axis); });
    extents[axis] = {-(along(*high, axis) - along(*low, axis)), axis};
  }
  std::sort(extents.begin(), extents.end());
  return {std::min(extents[0].second, extents[1].second), std::max(extents[0].second, extents[1].second)};
}

Panel map_panel(const Evaluation& e, const Trajectory& truth, const Trajectory& estimate) {
  std::vector<Vec3> true_positions, positions;
  for (const Match& match : e.ate.matches) {
    true_positions.push_back(truth[match.truth_idx].world_from_camera.translation);
    positions.push_back(e.ate.alignment * estimate[match.estimate_idx].world_from_camera.translation);
  }
  const auto [first, second] = widest_axes(true_positions);
  const auto seen = [a = first, b = second](Vec3 v) { return cv::Point2d(along(v, a), along(v, b)); };
  Series differences{"difference", {}, kError}, truth_line{"truth", {}, kTruth},
      line{"estimate, aligned", {}, kEstimate};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    truth_line.points.push_back(seen(true_positions[i]));
    line.points.push_back(seen(positions[i]));
    differences.points.insert(differences.points.end(),
                              {seen(true_positions[i]), seen(positions[i]), {NAN, NAN}});
  }
  const char* names[3] = {"x [m]", "y [m]", "z [m]"};
  Panel panel{"trajectory", names[first], names[second], {differences, truth_line, line}};
  panel.equal_scale = true;
  return panel;
}

Panel error_panel(const Evaluation& e, const Trajectory& estimate) {
  const double start_s = estimate.front().stamp_s;
  Series ate{"ATE", {}, kError}, rpe{"RPE 1 s, translation", {}, kEstimate};
  for (std::size_t i = 0; i < e.ate.matches.size(); ++i)
    ate.points.emplace_back(estimate[e.ate.matches[i].estimate_idx].stamp_s - start_s, e.ate.error_m[i]);
  Panel panel{"error", "time [s]", "[m]", {ate}};
  if (!e.rpe.empty() && e.rpe.front().pairs_rule == "1 s") {
    for (const RelativeError& error : e.rpe.front().errors)
      rpe.points.emplace_back(estimate[error.from_idx].stamp_s - start_s, error.translation_m);
    panel.series.insert(panel.series.begin(), rpe);
  }
  panel.from_zero = true;
  return panel;
}

}  // namespace

cv::Mat plot(const Evaluation& evaluation, const Trajectory& truth, const Trajectory& estimate) {
  return draw({map_panel(evaluation, truth, estimate), error_panel(evaluation, estimate)});
}

}  // namespace sediment::tools
