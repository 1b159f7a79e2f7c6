#pragma once

#include <functional>

#include "stages/track/block_system.hpp"
#include "stages/track/bundle_adjustment.hpp"

namespace sediment::track {

/// What is being solved for: cameras, points, and the change of the sensor's timing.
struct BundleState {
  std::vector<Pose> cameras;  ///< camera_from_world
  std::vector<Vec3> points;
  std::array<double, 2> timing{};  ///< readout, depth lag
};

/// The normal equations of a bundle with the points eliminated (Schur complement; Triggs et al. 2000). Free
/// cameras are rows of six; the timing, if it is solved for, is the last row, of which two are used. Points
/// are dealt with in a fixed number of parts whose sums are added in order: the same bits on any number of
/// threads.
class NormalEquations {
 public:
  /// `bundle` and `pinhole` must outlive it.
  NormalEquations(const Bundle& bundle, const Pinhole& pinhole, const AdjustmentRule& rule);

  /// Half the sum of the squared residuals under the loss; infinite if a point is behind a camera.
  double cost(const BundleState& state) const;
  /// First and second derivatives at a state.
  void linearise(const BundleState& state);
  /// Levenberg's step: the diagonal is raised by its `damping`-fold. False if there is none.
  bool solve(double damping);
  BundleState moved(const BundleState& state) const;
  /// By how much the quadratic model says the last step lowers the cost.
  double promised_gain() const { return promised_gain_; }

 private:
  using Tall = Eigen::Matrix<double, 6, 3>;
  /// Sums over a part of the points.
  struct Part {
    std::vector<Block> blocks;
    std::vector<Vector6> right;
  };
  struct Sight {
    int row = -1, camera_idx = 0;  ///< row -1: the camera is fixed
    const Measurement* measurement = nullptr;
  };

  static constexpr std::size_t kParts = 4;
  /// Is given a part's number and the range of its points.
  using PartWork = std::function<void(std::size_t part, std::size_t begin, std::size_t end)>;
  void for_parts(const PartWork& work) const;
  Part empty_part() const;
  Part sum(const std::vector<Part>& parts) const;
  void linearise_point(const BundleState& state, std::size_t point_idx, Part& part);
  void add_links(const BundleState& state, Part& part) const;
  double link_cost(const BundleState& state) const;
  void eliminate_point(std::size_t point_idx, double damping, Part& part) const;
  double substitute_point(std::size_t point_idx, double damping);

  const Bundle& bundle_;
  const Pinhole& pinhole_;
  AdjustmentRule rule_;
  std::vector<int> row_of_;  ///< per camera
  int timing_row_ = -1;
  std::vector<std::size_t> first_;  ///< per point and one more: into sights_
  std::vector<Sight> sights_;       ///< by point, then by camera
  std::unique_ptr<BlockSystem> system_;
  std::vector<Block> link_roots_;  ///< per link: square root of its information

  Part direct_;                         ///< of cameras, timing and links
  std::vector<Tall> mixed_;             ///< per sight: second derivatives by camera and point
  std::vector<Tall> mixed_timing_;      ///< per point
  std::vector<Eigen::Matrix3d> own_;    ///< per point: second derivatives
  std::vector<Eigen::Vector3d> slope_;  ///< per point: gradient
  std::vector<Vector6> step_;
  std::vector<Eigen::Vector3d> point_step_;
  double promised_gain_ = 0;
};

}  // namespace sediment::track
