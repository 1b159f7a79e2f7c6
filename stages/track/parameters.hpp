#pragma once

namespace sediment::track {

/// Where the poses come from.
enum class Engine { orb, given };

/// What a pose may rest on: the whole recording, or only the frames up to its own.
enum class Mode { offline, causal };

/// Everything that tunes tracking; the only place where a default is written.
struct Parameters {
  Engine engine = Engine::orb;
  Mode mode = Mode::offline;
  int features = 1500;         ///< ORB features a frame, over all pyramid levels
  int mask_halo_px = 5;        ///< no feature this close to a dynamic pixel
  bool still_features = true;  ///< features on dynamic pixels serve in the end, where they hold still
  double depth_max_m = 8;      ///< measurements beyond are not used
  double depth_noise =
      0.0014;  ///< standard deviation of the inverse depth [1/m]: sigma_z = depth_noise * z^2
  double pixel_noise_px = 0.7;  ///< standard deviation of a feature's position at pyramid level 0
  int passes =
      6;  ///< at most: of measuring keyframes and adjusting, until the sensor's timing is settled; 0: none
  bool smoothing = true;      ///< poses are smoothed in time, as far as their noise goes
  double min_coverage = 0.5;  ///< an error if a smaller share of the frames has a pose
  bool diagnostics = false;   ///< also pictures of the keyframes and of the residuals
  double max_gap_s = 0.1;     ///< engine given: longest gap between poses that is interpolated
};

}  // namespace sediment::track
