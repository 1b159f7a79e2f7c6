#include <onnxruntime_cxx_api.h>

#include <array>
#include <stdexcept>

#include "stages/segment/network/network.hpp"

namespace sediment::segment {
namespace {

/// One session for all threads, each Run on the thread of its caller: frames are the parallel unit. That
/// gives more frames a second than sharing one frame among threads, and the same bits at any number of
/// threads.
class OnnxRuntimeNetwork final : public Network {
 public:
  OnnxRuntimeNetwork(const onnx::Model& model, const onnx::Layout& layout, cv::Size input_size)
      : file_(model.file.string()), layout_(layout), input_size_(input_size) {
    Ort::SessionOptions options;
    options.SetIntraOpNumThreads(1);
    options.SetInterOpNumThreads(1);
    options.SetExecutionMode(ORT_SEQUENTIAL);
    options.SetGraphOptimizationLevel(ORT_ENABLE_ALL);
    session_ = Ort::Session(environment_, model.file.c_str(), options);
  }

  Prediction run(const cv::Mat& input) const override try {
    const std::array<std::int64_t, 4> shape = {1, 3, input_size_.height, input_size_.width};
    const auto cpu = Ort::MemoryInfo::CreateCpu(OrtArenaAllocator, OrtMemTypeDefault);
    // The runtime only reads it; its interface lacks the const.
    auto* pixels = const_cast<float*>(input.ptr<float>());
    const Ort::Value image =
        Ort::Value::CreateTensor<float>(cpu, pixels, input.total(), shape.data(), shape.size());
    const std::array input_names = {layout_.input.c_str()};
    const std::array output_names = {layout_.anchors.c_str(), layout_.prototypes.c_str()};
    auto outputs = std::make_shared<std::vector<Ort::Value>>(
        session_.Run(Ort::RunOptions{nullptr}, input_names.data(), &image, 1, output_names.data(), 2));
    return prediction(outputs);
  } catch (const Ort::Exception& error) {
    throw std::runtime_error(file_ + ": ONNX Runtime: " + error.what());
  }

 private:
  Prediction prediction(const std::shared_ptr<std::vector<Ort::Value>>& outputs) const {
    const auto anchors = outputs->at(0).GetTensorTypeAndShapeInfo().GetShape();
    const auto prototypes = outputs->at(1).GetTensorTypeAndShapeInfo().GetShape();
    const auto rows = 4 + layout_.class_names.size() + static_cast<std::size_t>(layout_.mask_coefficients);
    const bool fits = anchors.size() == 3 && anchors[1] == static_cast<std::int64_t>(rows) &&
                      prototypes.size() == 4 && prototypes[1] == layout_.mask_coefficients;
    if (!fits) throw std::runtime_error(file_ + ": the outputs are not of the declared shapes");
    Prediction prediction;
    prediction.memory = outputs;
    prediction.anchors = cv::Mat(static_cast<int>(rows), static_cast<int>(anchors[2]), CV_32F,
                                 outputs->at(0).GetTensorMutableData<float>());
    prediction.mask_size = {static_cast<int>(prototypes[3]), static_cast<int>(prototypes[2])};
    prediction.prototypes = cv::Mat(layout_.mask_coefficients, prediction.mask_size.area(), CV_32F,
                                    outputs->at(1).GetTensorMutableData<float>());
    return prediction;
  }

  std::string file_;
  onnx::Layout layout_;
  cv::Size input_size_;
  Ort::Env environment_{ORT_LOGGING_LEVEL_ERROR, "segment"};
  mutable Ort::Session session_{nullptr};  // Run() is thread-safe but not const
};

}  // namespace

std::string onnxruntime_version() {
  return Ort::GetVersionString();
}

std::unique_ptr<Network> open_with_onnxruntime(const onnx::Model& model, const onnx::Layout& layout,
                                               cv::Size input_size) try {
  return std::make_unique<OnnxRuntimeNetwork>(model, layout, input_size);
} catch (const Ort::Exception& error) {
  throw std::runtime_error(model.file.string() + ": ONNX Runtime cannot load it: " + error.what());
}

}  // namespace sediment::segment
