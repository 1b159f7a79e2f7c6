#pragma once

#include <vector>

#include "stages/track/map.hpp"
#include "stages/track/pinhole.hpp"

namespace sediment::track {

/// A feature of the frame in hand that shows a landmark.
struct Match {
  int feature_idx = 0, point_id = 0;
};

/// Where a landmark is expected in an image.
struct Target {
  int point_id = 0;
  Pixel pixel;
  double inverse_depth = 0;  ///< expected, 1/m
  int octave = 0;            ///< expected
  const Descriptor* descriptor = nullptr;
};

struct SearchRule {
  double radius_px = 7;         ///< at octave 0; grows with the expected octave
  int max_distance = 100;       ///< bits of 256
  double best_to_second = 0.9;  ///< the best match must be this much better than the second
};

/// The feature that fits each target best among those nearby whose octave and depth agree. `taken` (one entry
/// a feature, not 0 = in use) are left out. A feature serves one target: the one with the nearer descriptor.
/// Ordered by feature.
std::vector<Match> match_targets(const std::vector<Target>& targets, const FrameFeatures& features,
                                 const std::vector<char>& taken, const Pinhole& pinhole,
                                 const SearchRule& rule);

/// Targets of those landmarks that a camera at this pose should see: in the image, within their range of
/// distance, and from less than 60 degrees beside the mean direction they were seen from.
std::vector<Target> visible_targets(const Map& map, const std::vector<int>& point_ids, const Pinhole& pinhole,
                                    const Pose& camera_from_world);

/// Pairs of features (first, second) that are each other's nearest by descriptor, of all features with
/// `first_used[i]` not 0, and clearly nearer than the runner-up.
std::vector<std::pair<int, int>> match_descriptors(const FrameFeatures& first,
                                                   const std::vector<char>& first_used,
                                                   const FrameFeatures& second);

}  // namespace sediment::track
