#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "stages/octree/leaf_points.hpp"

namespace sediment::octree {

enum class LabelFusion {
  majority,  ///< each point has one vote; confidence is a share of the votes
  bayes      ///< each point is an observation; confidence is a probability
};

struct LabelParameters {
  LabelFusion fusion = LabelFusion::majority;
  double missed = 0.4;  ///< probability that a network leaves a point of a class unlabelled
  double wrong = 0.05;  ///< probability that it gives a point one particular label that is not its own
};

struct LabelBelief {
  std::uint32_t label = kUnlabelled;
  float confidence = 0;  ///< 0 .. 1; 0 also where there is no such label
};

/// The most credible labels of a leaf, best first, among equals the smaller id. Without points: none.
///
/// bayes: every label that occurs, and "unlabelled", is a hypothesis c, all equally likely beforehand. Point
/// i with label o multiplies its probability by P(o | c): 1 - missed - wrong for o = c, missed for a point
/// without label, wrong for any other label; where c is "unlabelled", 1 - wrong and wrong. The points of a
/// leaf come from few frames and are wrong together, so that they count as at most kIndependent
/// observations.
inline constexpr double kIndependent = 8;
std::array<LabelBelief, 3> label_beliefs(std::span<const LeafPoint> points,
                                         const LabelParameters& parameters);

}  // namespace sediment::octree
