#include "pipeline/artifacts/object_mask.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace sediment {

std::optional<ObjectMask> object_of(std::string class_name, double score, const cv::Mat& pixels) {
  const cv::Rect window = cv::boundingRect(pixels);
  if (window.empty()) return std::nullopt;
  const std::array<double, 4> box{1.0 * window.x, 1.0 * window.y, 1.0 * window.br().x, 1.0 * window.br().y};
  return ObjectMask{std::move(class_name), score, box, window, pixels(window).clone()};
}

InstanceMask paint(std::vector<ObjectMask> objects, cv::Size image) {
  std::ranges::stable_sort(objects, std::ranges::greater{}, &ObjectMask::score);
  InstanceMask mask{cv::Mat::zeros(image, CV_16UC1), {}};
  for (ObjectMask& object : objects) {
    const int id = static_cast<int>(mask.instances.size()) + 1;
    if (id > std::numeric_limits<std::uint16_t>::max()) break;
    bool visible = false;
    for (int y = 0; y < object.window.height; ++y) {
      const auto* from = object.pixels.ptr<std::uint8_t>(y);
      auto* to = mask.ids.ptr<std::uint16_t>(object.window.y + y) + object.window.x;
      for (int x = 0; x < object.window.width; ++x) {
        if (from[x] == 0 || to[x] != 0) continue;
        to[x] = static_cast<std::uint16_t>(id);
        visible = true;
      }
    }
    if (visible) mask.instances.push_back({id, std::move(object.class_name), object.score, object.box_px});
  }
  return mask;
}

}  // namespace sediment
