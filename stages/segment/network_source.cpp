#include "stages/segment/network_source.hpp"

#include <atomic>
#include <chrono>

#include "stages/segment/instance_masks.hpp"
#include "stages/segment/network/network.hpp"
#include "stages/segment/onnx/layout.hpp"
#include "stages/segment/selection.hpp"

namespace sediment::segment {
namespace {

using Clock = std::chrono::steady_clock;

/// Of the network for images of this size.
cv::Size input_size_for(const onnx::Layout& layout, cv::Size image, int longest) {
  if (longest == 0) longest = std::max(layout.trained_size.height, layout.trained_size.width);
  cv::Size size = smallest_input(image, longest, layout.stride);
  if (layout.input_size.height > 0) size.height = layout.input_size.height;
  if (layout.input_size.width > 0) size.width = layout.input_size.width;
  return size;
}

class NetworkSource final : public MaskSource {
 public:
  NetworkSource(const Parameters& parameters, Engine engine, const Sequence& sequence,
                const std::filesystem::path& model_file)
      : engine_(engine), sequence_(sequence) {
    const onnx::Model model(model_file);
    const onnx::Layout layout = onnx::read_layout(model, parameters.class_names);
    class_names_ = layout.class_names;
    selection_ = select(parameters, class_names_);
    const cv::Size image(sequence.camera().width, sequence.camera().height);
    letterbox_ = fit(image, input_size_for(layout, image, parameters.input_size));
    const auto open = engine == Engine::opencv ? open_with_opencv : open_with_onnxruntime;
    network_ = open(model, layout, letterbox_.input);
  }

  InstanceMask masks_of(std::size_t frame_idx) const override {
    const cv::Mat input = to_input(sequence_.color(frame_idx), letterbox_);
    const auto started = Clock::now();
    const Prediction prediction = network_->run(input);
    inference_ns_ += std::chrono::nanoseconds(Clock::now() - started).count();
    return paint(assemble(prediction, detect(prediction, selection_), letterbox_, class_names_),
                 letterbox_.image);
  }

  std::string engine() const override { return engine_ == Engine::opencv ? "opencv" : "onnxruntime"; }
  double inference_s() const override { return static_cast<double>(inference_ns_) * 1e-9; }

 private:
  Engine engine_;
  const Sequence& sequence_;
  std::vector<std::string> class_names_;
  Selection selection_;
  Letterbox letterbox_;
  std::unique_ptr<Network> network_;
  mutable std::atomic<std::int64_t> inference_ns_{0};
};

}  // namespace

std::unique_ptr<MaskSource> open_network_source(const Parameters& parameters, Engine engine,
                                                const Sequence& sequence,
                                                const std::filesystem::path& model) {
  return std::make_unique<NetworkSource>(parameters, engine, sequence, model);
}

}  // namespace sediment::segment
