#include "stages/interaction-mask/motion.hpp"

#include <algorithm>
#include <map>

namespace sediment::interaction_mask {
namespace {

/// One object's states by frame.
using Life = std::map<int, ObjectState>;

/// Frames first .. last of one motion.
struct Motion {
  int first, last;
};

/// Stretches of a life without a rest in which enough frames show certain motion. Frames in which the object
/// is not seen, or its speed is not known, neither end nor prove a motion.
std::vector<Motion> motions_of(const Life& life, const MotionParameters& parameters) {
  std::vector<Motion> motions;
  int first = -1, last = -1, certain = 0;
  const auto close = [&] {
    if (first >= 0 && certain >= parameters.min_frames) motions.push_back({first, last});
    first = -1;
    certain = 0;
  };
  for (const auto& [frame, state] : life) {
    if (first >= 0 && frame - last > parameters.memory) close();
    if (!state.speed_m_s) continue;
    if (*state.speed_m_s < parameters.stop_m_s) {
      close();
      continue;
    }
    if (first < 0) first = frame;
    last = frame;
    certain += *state.speed_m_s > parameters.start_m_s;
  }
  close();
  return motions;
}

bool touched_near(const Life& life, const Motion& motion, int memory) {
  const auto end = life.upper_bound(motion.last + memory);
  return std::any_of(life.lower_bound(motion.first - memory), end,
                     [](const auto& state) { return state.second.touched; });
}

}  // namespace

std::vector<std::set<int>> moved_objects(const std::vector<std::vector<ObjectState>>& frames,
                                         const MotionParameters& parameters) {
  std::map<int, Life> lives;
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    for (const ObjectState& state : frames[frame]) lives[state.id][static_cast<int>(frame)] = state;

  std::vector<std::set<int>> moved(frames.size());
  for (const auto& [id, life] : lives) {
    for (const auto& [frame, state] : life)
      if (state.touched && !state.speed_m_s) moved[static_cast<std::size_t>(frame)].insert(id);
    for (const Motion& motion : motions_of(life, parameters)) {
      if (!touched_near(life, motion, parameters.memory)) continue;
      const auto end = life.upper_bound(motion.last + parameters.margin);
      for (auto state = life.lower_bound(motion.first - parameters.margin); state != end; ++state)
        moved[static_cast<std::size_t>(state->first)].insert(id);
    }
  }
  return moved;
}

}  // namespace sediment::interaction_mask
