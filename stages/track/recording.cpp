#include "stages/track/recording.hpp"

namespace sediment::track {

Recording recording_of(const Sequence& sequence, const DynamicMasksReader* masks) {
  Recording recording;
  recording.camera = sequence.camera();
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    recording.stamps.push_back(sequence.entry(i).stamp);
    recording.stamps_s.push_back(sequence.entry(i).stamp_s);
    recording.depth_stamps_s.push_back(sequence.entry(i).depth_stamp_s);
  }
  recording.frame = [&sequence](std::size_t i) { return sequence.frame(i); };
  recording.depth = [&sequence](std::size_t i) { return sequence.depth(i); };
  if (masks)
    recording.dynamic_mask = [&sequence, masks](std::size_t i) {
      return masks->read(sequence.entry(i).stamp);
    };
  return recording;
}

}  // namespace sediment::track
