// Wall time per frame of the whole stage (reading, network, masks, writing) against the network alone, in
// rounds of the same run; printed as Markdown. Arguments: network, sequence, rounds; default: those of the
// real data.
#include <onnxruntime_cxx_api.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include "benchmarks/timing.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "stages/segment/network/letterbox.hpp"
#include "stages/segment/network/network.hpp"
#include "stages/segment/segment_sequence.hpp"
#include "tests/support/needs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::segment;
namespace fs = std::filesystem;

namespace {

const int kThreads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

/// Of wall time, and of the processors of all threads: the latter says the same on a busy machine too.
struct Cost {
  double wall_ms = 0, processor_ms = 0;
};

double processor_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) * 1e-3;
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

template <class Work>
Cost cost(const Work& work, std::size_t frames) {
  const double processor_before = processor_ms();
  const auto start = std::chrono::steady_clock::now();
  work();
  const double wall_ms = 1e3 * benchmark::seconds_since(start);
  const auto count = static_cast<double>(frames);
  return {wall_ms / count, (processor_ms() - processor_before) / count};
}

/// The network alone, all threads on one frame: ONNX Runtime as most programs use it.
class SharedFrame {
 public:
  SharedFrame(const fs::path& model, cv::Mat input) : input_(std::move(input)) {
    Ort::SessionOptions options;
    options.SetIntraOpNumThreads(kThreads);
    options.SetGraphOptimizationLevel(ORT_ENABLE_ALL);
    session_ = Ort::Session(environment_, model.c_str(), options);
  }
  void run(std::size_t frames) {
    const auto cpu = Ort::MemoryInfo::CreateCpu(OrtArenaAllocator, OrtMemTypeDefault);
    const std::array<std::int64_t, 4> shape = {1, 3, input_.size[2], input_.size[3]};
    const Ort::Value image =
        Ort::Value::CreateTensor<float>(cpu, input_.ptr<float>(), input_.total(), shape.data(), 4);
    Ort::AllocatorWithDefaultOptions allocator;
    const auto in = session_.GetInputNameAllocated(0, allocator);
    const auto first = session_.GetOutputNameAllocated(0, allocator),
               second = session_.GetOutputNameAllocated(1, allocator);
    const std::array inputs = {static_cast<const char*>(in.get())};
    const std::array outputs = {static_cast<const char*>(first.get()),
                                static_cast<const char*>(second.get())};
    for (std::size_t i = 0; i < frames; ++i)
      session_.Run(Ort::RunOptions{nullptr}, inputs.data(), &image, 1, outputs.data(), outputs.size());
  }

 private:
  cv::Mat input_;
  Ort::Env environment_;
  Ort::Session session_{nullptr};
};

/// The network alone, each thread on a frame of its own.
void run_frame_per_thread(const Network& network, const cv::Mat& input, std::size_t frames) {
  tbb::task_arena(kThreads).execute([&] {
    tbb::parallel_for(
        std::size_t{0}, frames, [&](std::size_t) { network.run(input); }, tbb::simple_partitioner());
  });
}

/// All that the program does, start-up included.
void run_stage(const fs::path& model, const Sequence& sequence, Engine engine) {
  const test::TemporaryFolder folder;
  Parameters parameters;
  parameters.engine = engine;
  const auto source = open_source(parameters, sequence, model, std::nullopt);
  MasksWriter writer(folder.path());
  segment_sequence(*source, sequence.size(), kThreads, [&](std::size_t frame_idx, const InstanceMask& mask) {
    writer.write(sequence.entry(frame_idx).stamp, mask);
  });
  writer.finish();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

void compare(const fs::path& model_file, const Sequence& sequence, int rounds) {
  const onnx::Model model(model_file);
  const onnx::Layout layout = onnx::read_layout(model);
  const cv::Size size(layout.input_size.width, layout.input_size.height);
  const cv::Mat input =
      to_input(sequence.color(0), fit({sequence.camera().width, sequence.camera().height}, size));
  const auto onnxruntime = open_with_onnxruntime(model, layout, size),
             opencv = open_with_opencv(model, layout, size);
  SharedFrame shared(model_file, input);
  const std::size_t frames = sequence.size();
  struct Row {
    const char* name;
    std::function<void()> work;
    std::vector<double> wall_ms{}, wall_ratio{}, processor_ms{}, processor_ratio{};
  };
  std::vector<Row> rows = {
      {"ONNX Runtime alone, a frame per thread", [&] { run_frame_per_thread(*onnxruntime, input, frames); }},
      {"ONNX Runtime alone, all threads on a frame", [&] { shared.run(frames); }},
      {"the stage, onnxruntime", [&] { run_stage(model_file, sequence, Engine::onnxruntime); }},
      {"OpenCV alone, a frame per thread", [&] { run_frame_per_thread(*opencv, input, frames); }},
      {"the stage, opencv", [&] { run_stage(model_file, sequence, Engine::opencv); }}};
  for (int round = 0; round < rounds; ++round) {
    for (Row& row : rows) {
      const auto [wall, processor] = cost(row.work, frames);
      row.wall_ms.push_back(wall);
      row.processor_ms.push_back(processor);
      row.wall_ratio.push_back(wall / rows[0].wall_ms.back());
      row.processor_ratio.push_back(processor / rows[0].processor_ms.back());
    }
  }
  std::printf("\n%s, %zu frames, %d threads, median of %d rounds\n\n", model_file.filename().c_str(), frames,
              kThreads, rounds);
  std::printf("| | wall ms a frame | ratio | processor ms a frame | ratio |\n|---|---|---|---|---|\n");
  for (const Row& row : rows)
    std::printf("| %s | %.1f | %.2f | %.1f | %.2f |\n", row.name, median(row.wall_ms), median(row.wall_ratio),
                median(row.processor_ms), median(row.processor_ratio));
}

}  // namespace

int main(int argc, char** argv) try {
  const int rounds = argc > 3 ? std::stoi(argv[3]) : 3;
  if (argc > 2) {
    compare(argv[1], Sequence::open(argv[2]), rounds);
    return 0;
  }
  const auto root = test::needs("tum/rgbd_dataset_freiburg1_rpy_person");
  if (!root) return 0;
  const test::TemporaryFolder folder;
  std::ofstream(folder / "sequence.yaml")
      << "root: " << *root << "\ncamera: " SEDIMENT_SOURCE_DIR "/configs/cameras/freiburg1.yaml\n";
  for (const char* name : {"yolov8n-seg-320.onnx", "yolov8n-seg-480x640.onnx", "yolov8n-seg-640.onnx"})
    if (const auto model = test::needs(std::string("models/") + name))
      compare(*model, Sequence::open(folder / "sequence.yaml"), rounds);
} catch (const std::exception& error) {
  std::fprintf(stderr, "benchmark-segment: %s\n", error.what());
  return 1;
}
