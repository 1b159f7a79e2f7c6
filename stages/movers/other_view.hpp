// What a frame near in time adds to the regions of a frame.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "stages/movers/contradiction.hpp"

namespace sediment::movers {

/// Those regions of a view of which another view shows at least half, moved by no more than `reach_px`: a
/// region of `there` (or what is masked there) lies near where each pixel would be if it stood still.
/// Returns a label image's kept regions as a mask: 255 where the region is confirmed.
cv::Mat confirmed_by(const cv::Mat& regions, const View& view, const cv::Mat& regions_there,
                     const View& there, const Camera& camera, const std::vector<Ray>& rays, int reach_px);

/// The pixels of a view (255, on the grid) that another view shows in the same place, inside its regions.
cv::Mat carried_from(const cv::Mat& regions_there, const View& there, const View& view, const Camera& camera,
                     const std::vector<Ray>& rays);

}  // namespace sediment::movers
