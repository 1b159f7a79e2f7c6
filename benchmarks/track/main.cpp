// What tracking costs a frame: the first quarter, half and all of a sequence (time and memory must not grow
// faster than the frames), then what each part adds, with one and two threads; printed as Markdown.
// Arguments: SEQUENCE.yaml [folder of dynamic masks]
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>

#include "benchmarks/timing.hpp"
#include "stages/track/recording.hpp"

using namespace sediment;
using namespace sediment::track;

namespace {

/// Of wall time, and of the processors of all threads.
struct Cost {
  double wall_ms = 0, processor_ms = 0;
};

double processor_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

template <class Work>
Cost cost_a_frame(std::size_t frames, const Work& work) {
  const double before_ms = processor_ms();
  const auto start = std::chrono::steady_clock::now();
  work();
  const double wall_ms = 1e3 * benchmark::seconds_since(start);
  return {wall_ms / static_cast<double>(frames), (processor_ms() - before_ms) / static_cast<double>(frames)};
}

Recording beginning_of(Recording recording, std::size_t frames) {
  recording.stamps.resize(frames);
  recording.stamps_s.resize(frames);
  recording.depth_stamps_s.resize(frames);
  return recording;
}

void lengths(const Recording& recording) {
  std::printf(
      "| frames | coverage | wall, ms a frame | processor, ms a frame | peak of the program, MB "
      "|\n|---|---|---|---|---|\n");
  for (const std::size_t share : {4, 2, 1}) {
    const std::size_t frames = recording.stamps.size() / share;
    const Recording part = beginning_of(recording, frames);
    Tracked tracked;
    const Cost cost = cost_a_frame(frames, [&] { tracked = track::track(part, {}, {}); });
    std::printf("| %zu | %.1f %% | %.1f | %.1f | %.0f |\n", frames, 100 * coverage(tracked.frames),
                cost.wall_ms, cost.processor_ms, peak_mb());
  }
}

void row(const char* part, const Recording& recording, const Parameters& parameters) {
  const Cost cost = cost_a_frame(recording.stamps.size(), [&] { track::track(recording, parameters, {}); });
  std::printf("| %s | %.1f | %.1f |\n", part, cost.wall_ms, cost.processor_ms);
}

void parts(const Recording& recording) {
  std::printf("| up to and with | wall, ms a frame | processor, ms a frame |\n|---|---|---|\n");
  const std::size_t frames = recording.stamps.size();
  const Cost reading = cost_a_frame(
      frames, [&] { tbb::parallel_for(std::size_t{0}, frames, [&](std::size_t i) { recording.frame(i); }); });
  std::printf("| reading the images | %.1f | %.1f |\n", reading.wall_ms, reading.processor_ms);
  Parameters parameters;
  parameters.mode = Mode::causal;
  row("front end (mode causal)", recording, parameters);
  parameters.mode = Mode::offline;
  parameters.still_features = false;
  parameters.passes = 0;
  row("loops, every frame against the map (passes 0)", recording, parameters);
  parameters.passes = Parameters{}.passes;
  row("adjustments and timing of the sensor", recording, parameters);
  parameters.still_features = true;
  row("what holds still on dynamic pixels: all", recording, parameters);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: benchmark-track SEQUENCE.yaml [folder of dynamic masks]\n");
    return 2;
  }
  const Sequence sequence = Sequence::open(argv[1]);
  std::optional<DynamicMasksReader> masks;
  if (argc > 2) masks.emplace(argv[2]);
  const Recording recording = recording_of(sequence, masks ? &*masks : nullptr);
  lengths(recording);
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::printf("\nthreads: %zu\n\n", threads);
    parts(recording);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "benchmark-track: %s\n", error.what());
  return 1;
}
