#include "stages/track/reliable_depth.hpp"

#include <algorithm>
#include <array>

namespace sediment::track {

double reliable_depth_m(const cv::Mat& depth, int x, int y, double depth_scale, double depth_noise) {
  constexpr int kRadius_px = 1, kNeeded = 6;
  std::array<std::uint16_t, 9> values{};
  int count = 0;
  for (int v = std::max(0, y - kRadius_px); v <= std::min(depth.rows - 1, y + kRadius_px); ++v)
    for (int u = std::max(0, x - kRadius_px); u <= std::min(depth.cols - 1, x + kRadius_px); ++u)
      if (const std::uint16_t value = depth.at<std::uint16_t>(v, u)) values[count++] = value;
  if (count < kNeeded) return 0;
  std::sort(values.begin(), values.begin() + count);
  const double median_m = values[count / 2] / depth_scale;
  const double spread_m = (values[count - 1] - values[0]) / depth_scale;
  return spread_m > 0.01 + 6 * depth_noise * median_m * median_m ? 0 : median_m;
}

}  // namespace sediment::track
