#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sediment {

/// One RGB-D frame as the sensor gave it: lens distortion is in the images.
struct Frame {
  std::size_t frame_idx = 0;  ///< position in the windowed sequence
  std::string stamp;          ///< colour time stamp as written in rgb.txt; names every file about this frame
  double stamp_s = 0;
  cv::Mat color;  ///< CV_8UC3, BGR
  cv::Mat depth;  ///< CV_16UC1, camera.depth_scale units per metre, 0 = no value
};

/// An object found in one frame.
struct Instance {
  int id = 0;              ///< value of its pixels in the instance image, 1 and up, unique in its frame
  std::string class_name;  ///< as in the network's table, e.g. "person"
  double score = 1;        ///< 0 .. 1
  std::array<double, 4> box_px{};  ///< left top right bottom
  std::optional<double>
      speed_m_s{};  ///< against what stands still, across the view; if its producer knows it
};

/// The instances of one frame.
struct InstanceMask {
  cv::Mat ids;                      ///< CV_16UC1, size of the colour image, 0 = background
  std::vector<Instance> instances;  ///< by id, ascending
};

/// Values of a dynamic mask (CV_8UC1, size of the colour image).
enum DynamicValue : std::uint8_t { kStatic = 0, kPriorDynamic = 1, kNonPriorDynamic = 2 };

}  // namespace sediment
