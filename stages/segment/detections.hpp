#pragma once

#include <vector>

#include "stages/segment/network/network.hpp"

namespace sediment::segment {

/// Sides of a box; right and bottom are exclusive.
struct Box {
  float left = 0, top = 0, right = 0, bottom = 0;
  float area() const { return (right - left) * (bottom - top); }
};

/// Area of the intersection over area of the union; 0 if both are empty.
float overlap(const Box& a, const Box& b);

/// An object found by a network.
struct Detection {
  int class_idx = 0;
  float score = 0;
  Box box_px;          ///< in pixels of the network's input
  int anchor_idx = 0;  ///< column of Prediction::anchors
};

/// Which anchors become detections.
struct Selection {
  std::vector<float> confidence;  ///< lowest score, exclusive, by class; infinity: not wanted
  float iou = 0;
  std::size_t max_detections = 0;
};

/// Ultralytics' non_max_suppression: an anchor stands for its best class; those above the class's confidence
/// in order of their scores, of which one is dropped if it overlaps a kept one of its class by more than
/// `iou`; the first max_detections. Boxes that are not finite are no detections. Best first; equal scores in
/// order of the anchors.
std::vector<Detection> detect(const Prediction& prediction, const Selection& selection);

}  // namespace sediment::segment
