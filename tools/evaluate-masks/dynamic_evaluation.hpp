#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/evaluate-masks/overlap.hpp"
#include "tools/truth/instance_truth.hpp"
#include "tools/truth/mask_folder.hpp"

namespace sediment::tools {

/// Where a mover counts as visible and as missed.
struct MissRule {
  double visible_share = 0.01;  ///< of the image, more than this
  double least_recall = 0.5;    ///< below: missed
};

/// Pixels of the instances of one class, dynamic or static in their frame.
struct ClassPixels {
  std::uint64_t dynamic = 0, dynamic_masked = 0;
  std::uint64_t still = 0, still_masked = 0;
};

/// A visible mover that the mask does not cover.
struct MissedMover {
  std::string name;  ///< class and id, or "movers" where instances are not known
  double share = 0;  ///< of the image
  double recall = 0;
};

/// Masks of one frame.
struct FrameMasks {
  std::string stamp;
  Overlap overlap;
  std::optional<double> boundary_f;
  std::uint64_t prior = 0, prior_hit = 0;          ///< true pixels of value 1
  std::uint64_t non_prior = 0, non_prior_hit = 0;  ///< of value 2
  bool has_visible_mover = false;
  std::vector<MissedMover> missed;
  std::map<std::string, ClassPixels> classes;  ///< empty without true instances
};

/// Dynamic masks of a sequence against the truth.
struct DynamicEvaluation {
  std::vector<FrameMasks> frames;  ///< those that have both, in order of time
  std::size_t truth_frames = 0, mask_frames = 0;
  bool by_instance = false;  ///< whether true instances were known

  Overlap total() const;
  std::map<std::string, ClassPixels> classes() const;
  std::size_t frames_with_mover() const, missed_frames() const;
};

/// Throws std::runtime_error that names the frame: sizes that differ, no frame in common.
DynamicEvaluation evaluate_dynamic(const MaskFolder& truth, const MaskFolder& masks,
                                   const std::optional<InstanceTruth>& instances, const MissRule& rule = {});

}  // namespace sediment::tools
