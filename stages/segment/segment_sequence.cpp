#include "stages/segment/segment_sequence.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <mutex>

namespace sediment::segment {
namespace {

void add(Counts& counts, const InstanceMask& mask) {
  ++counts.frames;
  counts.instances += mask.instances.size();
  bool person = false;
  for (const Instance& instance : mask.instances) {
    ++counts.instances_per_class[instance.class_name];
    person = person || instance.class_name == "person";
  }
  if (mask.instances.empty()) ++counts.frames_without_instances;
  if (!person) ++counts.frames_without_person;
  counts.masked_pixels += static_cast<std::uint64_t>(cv::countNonZero(mask.ids));
  counts.pixels += mask.ids.total();
}

}  // namespace

Counts segment_sequence(const MaskSource& source, std::size_t frames, int threads,
                        const std::function<void(std::size_t frame_idx, const InstanceMask&)>& store) {
  Counts counts;
  std::mutex mutex;
  std::size_t next = 0;
  const auto in_order = tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                                            [&](tbb::flow_control& control) -> std::size_t {
                                                              if (next == frames) control.stop();
                                                              return next++;
                                                            });
  // Decoding, inference, masks and writing of one frame stay on one thread; frames overlap. Cheaper than a
  // thread for each step: nothing is handed over, and no thread waits for the slowest step.
  const auto whole_frame =
      tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, [&](std::size_t frame_idx) {
        const InstanceMask mask = source.masks_of(frame_idx);
        store(frame_idx, mask);
        const std::lock_guard lock(mutex);
        add(counts, mask);
      });
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_pipeline(static_cast<std::size_t>(threads), in_order & whole_frame); });
  return counts;
}

}  // namespace sediment::segment
