#pragma once

#include <string>
#include <vector>

#include "pipeline/scene/trajectory.hpp"

namespace sediment::track {

/// Poses of a trajectory at the times of the frames: interpolated between neighbours at most `max_gap_s`
/// apart (linear, slerp), none elsewhere. Poses at the very time of a frame are taken as they are. Throws
/// std::runtime_error if a given pose is not finite.
std::vector<FrameTracking> resample(const Trajectory& given, const std::vector<std::string>& stamps,
                                    const std::vector<double>& stamps_s, double max_gap_s, Trajectory& poses);

/// Where neighbouring poses are further apart in time than what is interpolated.
struct Gaps {
  std::size_t count = 0;
  double longest_s = 0;  ///< 0 without a gap
};
Gaps gaps_of(const Trajectory& given, double max_gap_s);

}  // namespace sediment::track
