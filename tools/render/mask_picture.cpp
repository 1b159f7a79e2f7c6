#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "tools/render/annotation.hpp"
#include "tools/render/pictures.hpp"

namespace sediment::render {
namespace {

const cv::Vec3b kPriorDynamicColor{60, 60, 235}, kNonPriorDynamicColor{0, 160, 255};
constexpr int kTileWidth_px = 560;

std::vector<std::size_t> frames_of(const Sequence& sequence, const std::vector<std::string>& chosen) {
  std::vector<std::size_t> frames;
  if (chosen.empty()) {
    const std::size_t count = std::min<std::size_t>(6, sequence.size());
    for (std::size_t i = 0; i < count; ++i) frames.push_back((2 * i + 1) * sequence.size() / (2 * count));
    return frames;
  }
  for (const std::string& name : chosen) {
    std::size_t idx = 0;
    while (idx < sequence.size() && sequence.entry(idx).stamp != name) ++idx;
    if (idx == sequence.size() && name.find_first_not_of("0123456789") == std::string::npos &&
        name.size() < 9)
      idx = std::stoul(name);
    if (idx >= sequence.size())
      throw std::runtime_error("frame " + name + ": the sequence has frames 0 to " +
                               std::to_string(sequence.size() - 1) + ", and no colour stamp of that name");
    frames.push_back(idx);
  }
  return frames;
}

void tint(cv::Mat& image, const cv::Mat& where, cv::Vec3b bgr, double share) {
  cv::Mat colored(image.size(), CV_8UC3, cv::Scalar(bgr)), mixed;
  cv::addWeighted(image, 1 - share, colored, share, 0, mixed);
  mixed.copyTo(image, where);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(where.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(image, outlines, -1, cv::Scalar(bgr), 2, cv::LINE_AA);
}

void draw_instances(cv::Mat& image, const InstanceMask& mask) {
  for (const Instance& instance : mask.instances) {
    const Label* label = default_labels().find(instance.class_name);
    const cv::Vec3b bgr =
        label == nullptr ? cv::Vec3b{200, 200, 200} : cv::Vec3b{label->rgb[2], label->rgb[1], label->rgb[0]};
    tint(image, mask.ids == instance.id, bgr, 0.45);
  }
  for (const Instance& instance : mask.instances) {
    char text[96];
    std::snprintf(text, sizeof text, instance.score < 1 ? "%s %.2f" : "%s", instance.class_name.c_str(),
                  instance.score);
    const cv::Moments moments = cv::moments(mask.ids == instance.id, true);
    if (moments.m00 < 300) continue;
    const cv::Size size = text_size(text);
    cv::Point at(static_cast<int>(moments.m10 / moments.m00) - size.width / 2,
                 static_cast<int>(moments.m01 / moments.m00) + size.height / 2);
    at.x = std::clamp(at.x, 4, std::max(4, image.cols - size.width - 4));
    write_text(image, text, at);
  }
}

/// Dynamic pixels in the colours of the legend, hatched so that the picture stays visible.
void draw_dynamic(cv::Mat& image, const cv::Mat& dynamic) {
  cv::Mat hatch(image.size(), CV_8UC1);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) hatch.at<std::uint8_t>(v, u) = (u + v) % 12 < 4 ? 255 : 0;
  for (const auto& [value, bgr] :
       {std::pair{kPriorDynamic, kPriorDynamicColor}, {kNonPriorDynamic, kNonPriorDynamicColor}}) {
    const cv::Mat where = dynamic == value;
    tint(image, where, bgr, 0.3);
    image.setTo(cv::Scalar(bgr), where & hatch);
  }
}

}  // namespace

cv::Mat mask_picture(const MaskOptions& options) {
  const Sequence sequence = Sequence::open(options.sequence);
  const auto frames = frames_of(sequence, options.frames);
  std::vector<cv::Mat> tiles;
  for (const std::size_t idx : frames) {
    cv::Mat image = sequence.color(idx);
    const std::string& stamp = sequence.entry(idx).stamp;
    if (!options.masks.empty()) draw_instances(image, MasksReader(options.masks).read(stamp));
    if (!options.dynamic.empty()) draw_dynamic(image, DynamicMasksReader(options.dynamic).read(stamp));
    cv::resize(image, image, cv::Size(kTileWidth_px, image.rows * kTileWidth_px / image.cols), 0, 0,
               cv::INTER_AREA);
    write_text(image, "frame " + std::to_string(idx) + "  " + stamp, {10, image.rows - 12}, 0.85);
    tiles.push_back(image);
  }
  const int columns = std::clamp(options.columns, 1, static_cast<int>(tiles.size()));
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns, gap = 8;
  const int head = options.dynamic.empty() && options.title.empty() ? 0 : 44;
  const cv::Size tile = tiles.front().size();
  cv::Mat picture(head + rows * (tile.height + gap) + gap, columns * (tile.width + gap) + gap, CV_8UC3,
                  cv::Scalar(250, 250, 250));
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    tiles[i].copyTo(
        picture(cv::Rect({gap + column * (tile.width + gap), head + gap + row * (tile.height + gap)}, tile)));
  }
  add_title(picture, options.title);
  if (!options.dynamic.empty()) {
    int right = picture.cols - 16;
    for (const auto& [bgr, text] : {std::pair{kNonPriorDynamicColor, std::string("moved by somebody (2)")},
                                    {kPriorDynamicColor, std::string("moves by itself (1)")}}) {
      right -= text_size(text).width;
      write_text(picture, text, {right, 29});
      cv::rectangle(picture, cv::Rect(right - 24, 15, 16, 16), cv::Scalar(bgr), cv::FILLED);
      right -= 44;
    }
  }
  return picture;
}

}  // namespace sediment::render
