#pragma once

#include <map>
#include <string>
#include <vector>

#include "stages/repair/clip.hpp"

namespace sediment::repair {

/// One object through the sequence.
struct Track {
  std::map<std::string, double> class_scores;  ///< sum of the detections' scores, by class
  std::size_t last_idx = 0;                    ///< frame of its latest detection
  std::vector<std::size_t> frames;             ///< of its detections, ascending

  /// The class with the largest sum; of equals the first by name.
  const std::string& class_name() const;
};

struct LinkParameters {
  int max_gap = 0;  ///< frames that an object may go unseen and keep its identity
  double min_overlap =
      0.3;  ///< intersection over union with the object's earlier mask, carried along by the flow
  double min_overlap_other_class = 0.5;  ///< the same for a detection of another class
};

/// Gives the detections of the frame `frame_idx` to tracks: those of the frames before it that are in memory,
/// or new ones. Each detection's mask is compared with the latest masks of the tracks, along the pixels'
/// trails backward; the best overlap first, each once. Must be called for every frame in order.
void link(Clip& clip, std::size_t frame_idx, double depth_scale, const LinkParameters& parameters,
          std::vector<Track>& tracks);

}  // namespace sediment::repair
