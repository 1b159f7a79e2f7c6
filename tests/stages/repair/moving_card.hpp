#pragma once

#include "stages/repair/clip.hpp"
#include "tests/pipeline/motion/textured.hpp"

namespace sediment::repair::test {

constexpr double kScale = 5000;

/// Frames of 160 x 120: a textured card (40 x 60 pixels, 1 m away) that moves `step_px` to the right per
/// frame before a textured wall 2 m away. The detection is the card's exact mask, id 1, class person.
struct CardScene {
  cv::Mat wall = sediment::test::texture({160, 120}, 1), card = sediment::test::texture({40, 60}, 2);
  int step_px = 2;

  cv::Rect card_at(std::size_t frame_idx) const {
    return {20 + step_px * static_cast<int>(frame_idx), 30, 40, 60};
  }

  ClipFrame frame(std::size_t frame_idx) const {
    ClipFrame frame;
    frame.frame_idx = frame_idx;
    frame.stamp_s = 100 + static_cast<double>(frame_idx) / 30;
    frame.stamp = std::to_string(frame.stamp_s);
    frame.color = wall.clone();
    card.copyTo(frame.color(card_at(frame_idx)));
    frame.depth = cv::Mat(120, 160, CV_16UC1, cv::Scalar(2 * kScale));
    frame.depth(card_at(frame_idx)) = kScale;
    frame.flow_image = flow_image(frame.color);
    frame.detections = {cv::Mat(120, 160, CV_16UC1, cv::Scalar(0)), {{1, "person", 0.9}}};
    frame.detections.ids(card_at(frame_idx)) = 1;
    return frame;
  }
};

inline void forget_detections(ClipFrame& frame) {
  frame.detections.ids = 0;
  frame.detections.instances.clear();
}

/// Puts frames together and computes the flow between them.
inline Clip clip_of(std::vector<ClipFrame> frames) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const cv::Size full = frames[i].color.size();
    frames[i - 1].to_next = flow_between(frames[i - 1].flow_image, frames[i].flow_image, full);
    frames[i].to_previous = flow_between(frames[i].flow_image, frames[i - 1].flow_image, full);
  }
  Clip clip;
  for (ClipFrame& frame : frames) clip.push_back(std::move(frame));
  return clip;
}

/// Intersection over union of two masks.
inline double overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / std::max(1, cv::countNonZero(a | b));
}

}  // namespace sediment::repair::test
