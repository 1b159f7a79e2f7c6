#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/scene/frame.hpp"
#include "stages/repair/guide.hpp"
#include "stages/repair/vote.hpp"

namespace sediment::repair {

struct SnapParameters {
  int radius_px =
      14;  ///< neighbourhood; outlines are set right that are off by up to a quarter of it; 0: they stay
  int rounds = 2;
};

/// Moves the outline of a soft mask to the edges of depth and colour near it: each pixel within the radius of
/// the outline gets the mean share of the pixels around it that lie at its own depth and have its colour (a
/// joint bilateral filter). So background inside a mask that is too large joins the background, and a limb
/// outside one that is too small joins the limb; where neither depth nor colour changes, the outline stays.
void snap(SoftMask& mask, const Guide& guide, int rounds);

/// One image of ids from soft masks: at each pixel the track with the largest share above one half, the first
/// of equals; id = track + 1. Tracks without a pixel are left out. Instances get id, score and box.
InstanceMask harden(const std::vector<SoftMask>& masks, cv::Size size);

}  // namespace sediment::repair
