#pragma once

#include <vector>

#include "stages/track/pose_estimation.hpp"

namespace sediment::track {

/// Cameras, landmarks and what the ones measured of the others.
struct Bundle {
  struct Camera {
    Pose camera_from_world;
    bool fixed = false;
  };
  struct Observation {
    int camera_idx = 0, point_idx = 0;
    Measurement measurement;
  };
  struct Link {
    int from_idx = 0, to_idx = 0;  ///< cameras
    Pose to_from_from;
    std::array<double, 36> information{};
  };
  std::vector<Camera> cameras;
  std::vector<Link> links;
  std::vector<Vec3> points;
  std::vector<Observation> observations;
  SensorTiming timing;  ///< that the measurements were made with; improved if the rule says so
};

struct AdjustmentRule {
  int max_iterations = 10;
  bool robust = true;        ///< Huber loss at the 95 % bound; plain least squares without
  bool timing = false;       ///< finds the sensor's timing too, with a weak prior at 0 where nothing tells it
  bool parallel = false;     ///< over several threads; only where no other work is waiting for them
  double least_gain = 1e-5;  ///< share of the cost: a step that saves less is the last
};

/// Minimises the sum of the squared residuals over all cameras that are not fixed and over all points, in
/// place (Triggs et al., Bundle Adjustment: a Modern Synthesis, 2000): Levenberg-Marquardt, points eliminated
/// first. The order of all sums is fixed. Returns the final cost. Throws std::runtime_error if a point starts
/// behind a camera that measures it.
double adjust(Bundle& bundle, const Pinhole& pinhole, const AdjustmentRule& rule);

/// Squared residual of an observation in standard deviations; a large number behind the camera.
double chi_square(const Bundle& bundle, const Bundle::Observation& observation, const Pinhole& pinhole);

}  // namespace sediment::track
