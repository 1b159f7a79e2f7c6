#pragma once

#include <map>
#include <string>

#include "tools/truth/instance_truth.hpp"
#include "tools/truth/mask_folder.hpp"

namespace sediment::tools {

/// Found instances of one class against the true ones. A found and a true instance of a frame belong together
/// if their class is the same and their IoU is at least 0.5 (so that there is never a choice).
struct ClassInstances {
  std::size_t truth = 0;  ///< true instances, counted in every frame
  std::size_t found = 0;  ///< found instances, counted in every frame
  std::size_t matched = 0;
  double iou_sum = 0;        ///< of the matched
  std::size_t switches = 0;  ///< a true instance is matched with another id than when it was matched before
};

/// Instances of a sequence.
struct InstanceEvaluation {
  std::size_t frames = 0, truth_frames = 0;
  std::map<std::string, ClassInstances> classes;  ///< the classes of COCO, and those that were found
};

/// True instances of fewer than `least_pixels` pixels are asked of nobody: they do not count as true, and
/// neither do found ones that match them. Throws std::runtime_error that names the frame.
InstanceEvaluation evaluate_instances(const InstanceTruth& truth, const MasksReader& found,
                                      const std::vector<std::string>& truth_stamps, int least_pixels = 400);

}  // namespace sediment::tools
