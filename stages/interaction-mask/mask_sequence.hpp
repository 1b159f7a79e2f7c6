#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "stages/interaction-mask/dynamic_mask.hpp"
#include "stages/interaction-mask/motion.hpp"

namespace sediment::interaction_mask {

struct Parameters {
  TouchParameters touch;
  bool motion = false;  ///< what is touched is dynamic only while it moves
  MotionParameters motions;
  int halo_px = 0;
  bool preview = false;
};

struct Counts {
  std::uint64_t prior_dynamic_instances = 0, non_prior_dynamic_instances = 0;
  std::uint64_t pairs_in_reach = 0, pairs_interacting = 0;
  std::uint64_t dynamic_pixels = 0;
  std::map<std::string, int> unlisted_classes;  ///< instances of classes that the label table does not know
  bool speeds_unknown = false;  ///< with Parameters::motion: no object has a speed, the touch decided all
};

/// Writes the `dynamic-masks` artifact of a sequence into `out`, frames in parallel; `on_frame` is called
/// after each. With Parameters::motion the ids of the masks must hold through the sequence and their speeds
/// be known (stage repair); an object without a speed is dynamic where it is touched. Throws
/// std::runtime_error that names folder and frame.
Counts mask_sequence(const Sequence& sequence, const std::filesystem::path& masks, const LabelTable& labels,
                     const Parameters& parameters, const std::filesystem::path& out,
                     const std::function<void()>& on_frame);

}  // namespace sediment::interaction_mask
