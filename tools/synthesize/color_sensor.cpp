#include "tools/synthesize/color_sensor.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {

void expose(cv::Mat& color, double time_s, std::uint64_t scene_seed, std::uint64_t frame_seed) {
  const BandLimitedNoise drift(hash(scene_seed, 21), 0.05, 0.4), warmth(hash(scene_seed, 22), 0.03, 0.2);
  const float gain = static_cast<float>(1 + 0.025 * drift.at(time_s)),
              warm = static_cast<float>(0.008 * warmth.at(time_s));
  const float channel_gain[3] = {gain * (1 - warm), gain, gain * (1 + warm)};
  tbb::parallel_for(0, color.rows, [&](int v) {
    auto* pixel = color.ptr<cv::Vec3b>(v);
    const float y = 2.f * v / color.rows - 1;
    for (int u = 0; u < color.cols; ++u) {
      const float x = 2.f * u / color.cols - 1;
      const float vignette = 1 - 0.07f * (x * x + y * y);
      const std::uint64_t bits =
          hash(frame_seed, static_cast<std::uint64_t>(u), static_cast<std::uint64_t>(v));
      for (int c = 0; c < 3; ++c) {
        // Three bytes of chance each: a triangular-like bell of standard deviation 1.8.
        const int a = bits >> (20 * c) & 0xff, b = bits >> (20 * c + 6) & 0xff,
                  d = bits >> (20 * c + 12) & 0xff;
        const float noise = static_cast<float>(a + b + d - 382) * 0.0141f;
        pixel[u][c] = static_cast<std::uint8_t>(
            std::clamp(pixel[u][c] * vignette * channel_gain[c] + noise + 0.5f, 0.f, 255.f));
      }
    }
  });
}

}  // namespace sediment::synthetic
