#include "stages/repair/link.hpp"

#include <algorithm>
#include <set>

#include "stages/repair/trails.hpp"

namespace sediment::repair {
namespace {

constexpr double kSameClassBonus = 0.3;  ///< in overlap: so much worse may a mask of the same class fit
constexpr double kAgePenalty = 0.01;     ///< in overlap, per frame

struct Candidate {
  double rank = 0;
  std::size_t detection = 0;
  int track = 0;
};

/// Index of each id among the detections, -1 for none.
std::vector<int> index_by_id(const InstanceMask& mask) {
  std::vector<int> index(1, -1);
  for (std::size_t i = 0; i < mask.instances.size(); ++i) {
    const auto id = static_cast<std::size_t>(mask.instances[i].id);
    if (index.size() <= id) index.resize(id + 1, -1);
    index[id] = static_cast<int>(i);
  }
  return index;
}

/// Where grid pixels of two frames' detections fall together.
struct Overlaps {
  std::size_t columns = 0;
  std::vector<int> both, first, second;
  double over_union(std::size_t a, std::size_t b) const {
    const int shared = both[a * columns + b];
    return shared == 0 ? 0 : static_cast<double>(shared) / (first[a] + second[b] - shared);
  }
};

Overlaps overlaps_of(const PixelTrails& here, const ClipFrame& frame, const PixelTrails& there,
                     const ClipFrame& earlier) {
  const auto index_here = index_by_id(frame.detections), index_there = index_by_id(earlier.detections);
  Overlaps overlaps{earlier.detections.instances.size(), {}, {}, {}};
  overlaps.first.resize(frame.detections.instances.size());
  overlaps.second.resize(overlaps.columns);
  overlaps.both.resize(overlaps.first.size() * overlaps.columns);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const int a = index_here[here.nearest<std::uint16_t>(frame.detections.ids, i)];
    const int b = there.valid[i] ? index_there[there.nearest<std::uint16_t>(earlier.detections.ids, i)] : -1;
    if (a >= 0) ++overlaps.first[static_cast<std::size_t>(a)];
    if (b >= 0) ++overlaps.second[static_cast<std::size_t>(b)];
    if (a >= 0 && b >= 0)
      ++overlaps.both[static_cast<std::size_t>(a) * overlaps.columns + static_cast<std::size_t>(b)];
  }
  return overlaps;
}

/// How many frames back the oldest track was seen that may still go on: trails beyond it cost for nothing.
int farthest_track(std::size_t frame_idx, int reach, const std::vector<Track>& tracks) {
  int farthest = 0;
  for (const Track& track : tracks)
    if (track.last_idx + static_cast<std::size_t>(reach) >= frame_idx)
      farthest = std::max(farthest, static_cast<int>(frame_idx - track.last_idx));
  return farthest;
}

/// Detections that fit the latest detection of a track.
std::vector<Candidate> candidates_of(const Clip& clip, const ClipFrame& frame, double depth_scale,
                                     const LinkParameters& parameters, const std::vector<Track>& tracks) {
  std::vector<Candidate> candidates;
  if (frame.detections.instances.empty()) return candidates;
  const PixelTrails here = start_trails(frame.depth, kStep_px);
  walk(clip, frame.frame_idx, Direction::backward,
       farthest_track(frame.frame_idx, parameters.max_gap + 1, tracks), kStep_px, depth_scale,
       [&](const ClipFrame& earlier, const PixelTrails& there) {
         const auto& track_of = earlier.track_of;
         if (std::none_of(track_of.begin(), track_of.end(), [&](int track) {
               return tracks[static_cast<std::size_t>(track)].last_idx == earlier.frame_idx;
             }))
           return true;
         const Overlaps overlaps = overlaps_of(here, frame, there, earlier);
         for (std::size_t a = 0; a < overlaps.first.size(); ++a)
           for (std::size_t b = 0; b < overlaps.second.size(); ++b) {
             const Track& track = tracks[static_cast<std::size_t>(track_of[b])];
             if (track.last_idx != earlier.frame_idx) continue;
             const double overlap = overlaps.over_union(a, b);
             const bool same = track.class_name() == frame.detections.instances[a].class_name;
             if (overlap < (same ? parameters.min_overlap : parameters.min_overlap_other_class)) continue;
             const auto age = static_cast<double>(frame.frame_idx - earlier.frame_idx);
             candidates.push_back(
                 {overlap + (same ? kSameClassBonus : 0) - kAgePenalty * age, a, track_of[b]});
           }
         return true;
       });
  return candidates;
}

}  // namespace

const std::string& Track::class_name() const {
  return std::max_element(class_scores.begin(), class_scores.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

void link(Clip& clip, std::size_t frame_idx, double depth_scale, const LinkParameters& parameters,
          std::vector<Track>& tracks) {
  ClipFrame& frame = clip.at(frame_idx);
  auto candidates = candidates_of(clip, frame, depth_scale, parameters, tracks);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.rank > b.rank; });
  frame.track_of.assign(frame.detections.instances.size(), -1);
  std::set<int> taken;
  for (const Candidate& candidate : candidates)
    if (frame.track_of[candidate.detection] < 0 && taken.insert(candidate.track).second)
      frame.track_of[candidate.detection] = candidate.track;

  for (std::size_t i = 0; i < frame.track_of.size(); ++i) {
    if (frame.track_of[i] < 0) {
      frame.track_of[i] = static_cast<int>(tracks.size());
      tracks.emplace_back();
    }
    Track& track = tracks[static_cast<std::size_t>(frame.track_of[i])];
    const Instance& instance = frame.detections.instances[i];
    track.class_scores[instance.class_name] += instance.score;
    track.last_idx = frame_idx;
    track.frames.push_back(frame_idx);
  }
}

}  // namespace sediment::repair
