#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "stages/repair/clip.hpp"

namespace sediment::repair {

struct VoteParameters {
  int max_gap = 12;    ///< frames over which a missed detection is repaired, on either side; 0: none is
  int neighbors = 2;   ///< detections on either side that vote on each mask; 0: each frame decides alone
  double decay = 0.7;  ///< weight of a vote, per frame of distance; the frame's own detection has 1
};

/// How sure each pixel of a part of the image is to belong to a track.
struct SoftMask {
  int track = 0;
  double score = 0;  ///< mean score of the detections that voted
  cv::Rect where;    ///< part of the image
  cv::Mat share;     ///< CV_32FC1 of that size: share of the votes, 0 .. 1
};

/// The masks of one frame by vote: every pixel looks along its trail, backward and forward, what the
/// detections of the frames nearby say. A track without a detection in the frame takes its `neighbors` (at
/// least one) nearest detections on either side, up to max_gap frames away; one with a detection takes those
/// of the `neighbors` nearest frames. Only trusted detections vote. `may_appear` says which tracks may have a
/// mask in a frame that has not detected them. Ordered by track.
std::vector<SoftMask> vote(const Clip& clip, std::size_t frame_idx, double depth_scale,
                           const VoteParameters& parameters,
                           const std::function<bool(int track)>& may_appear);

}  // namespace sediment::repair
