#pragma once

#include <deque>
#include <string>
#include <vector>

#include "pipeline/motion/optical_flow.hpp"
#include "pipeline/scene/frame.hpp"

namespace sediment::repair {

/// One frame with what its neighbours know of it.
struct ClipFrame {
  std::size_t frame_idx = 0;
  std::string stamp;
  double stamp_s = 0;
  cv::Mat color;                   ///< CV_8UC3
  cv::Mat depth;                   ///< CV_16UC1
  cv::Mat flow_image;              ///< see flow_image()
  InstanceMask detections;         ///< as the network gave them
  std::vector<int> track_of;       ///< track index of each detection, in their order; set by linking
  std::vector<bool> trusted;       ///< by detection: false if it looks like a false one; set by confirming
  FlowField to_next, to_previous;  ///< empty at the ends of the sequence and across a break in time
};

/// The frames that are in memory: neighbours, by their index in the sequence.
class Clip {
 public:
  void push_back(ClipFrame frame) { frames_.push_back(std::move(frame)); }
  /// Forgets frames before `frame_idx`.
  void drop_before(std::size_t frame_idx) {
    while (!frames_.empty() && frames_.front().frame_idx < frame_idx) frames_.pop_front();
  }
  bool empty() const { return frames_.empty(); }
  std::size_t begin_idx() const { return frames_.front().frame_idx; }
  std::size_t end_idx() const { return frames_.back().frame_idx + 1; }
  bool has(std::size_t frame_idx) const {
    return !empty() && frame_idx >= begin_idx() && frame_idx < end_idx();
  }
  ClipFrame& at(std::size_t frame_idx) { return frames_.at(frame_idx - begin_idx()); }
  const ClipFrame& at(std::size_t frame_idx) const { return frames_.at(frame_idx - begin_idx()); }

 private:
  std::deque<ClipFrame> frames_;
};

}  // namespace sediment::repair
