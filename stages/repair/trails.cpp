#include "stages/repair/trails.hpp"

namespace sediment::repair {

void walk(const Clip& clip, std::size_t from_idx, Direction direction, int reach, int step_px,
          double depth_scale, const std::function<bool(const ClipFrame&, const PixelTrails&)>& visit) {
  PixelTrails trails = start_trails(clip.at(from_idx).depth, step_px);
  std::size_t at = from_idx;
  for (int steps = 0; steps < reach; ++steps) {
    const bool forward = direction == Direction::forward;
    const FlowField& flow = forward ? clip.at(at).to_next : clip.at(at).to_previous;
    if (flow.empty() || (!forward && at == clip.begin_idx()) || !clip.has(forward ? at + 1 : at - 1)) return;
    at = forward ? at + 1 : at - 1;
    const ClipFrame& frame = clip.at(at);
    follow(trails, flow, forward ? frame.to_previous : frame.to_next, frame.depth, depth_scale, {});
    if (!visit(frame, trails)) return;
  }
}

}  // namespace sediment::repair
