#include <algorithm>
#include <array>
#include <mutex>
#include <opencv2/dnn.hpp>
#include <stdexcept>
#include <utility>

#include "stages/segment/network/box_decoding.hpp"
#include "stages/segment/network/network.hpp"
#include "stages/segment/onnx/head.hpp"

namespace sediment::segment {
namespace {

/// [1, rows, ...] as a matrix of `rows` rows.
cv::Mat as_rows(const cv::Mat& tensor) {
  if (tensor.dims < 3 || tensor.size[0] != 1)
    throw std::runtime_error("an output is not of the declared shape");
  return tensor.reshape(1, tensor.size[1]);
}

/// A cv::dnn::Net runs one image at a time, so each thread borrows one. OpenCV's own threads are switched
/// off, for the same bits at any number of threads and because frames are the better parallel unit.
class OpenCvNetwork final : public Network {
 public:
  OpenCvNetwork(const onnx::Model& model, const onnx::Layout& layout, cv::Size input_size)
      : file_(model.file.string()),
        classes_(static_cast<int>(layout.class_names.size())),
        input_size_(input_size) {
    cv::setNumThreads(1);
    const onnx::Head head = onnx::find_head(model, layout);
    shared_ = head.bins == head.logits;
    has_products_ =
        std::ranges::any_of(model.nodes, [](const onnx::Node& node) { return node.op_type == "MatMul"; });
    cut_ = onnx::cut_before_decoding(model, layout, head, {input_size.height, input_size.width});
    idle_.push_back(load());  // here, so that a network that OpenCV cannot read fails before the first frame
  }

  Prediction run(const cv::Mat& input) const override try {
    cv::dnn::Net net = borrow();
    net.setInput(input);
    std::vector<cv::Mat> outputs;
    net.forward(outputs, output_layers(net));
    Prediction prediction = decoded(outputs);
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(net));
    return prediction;
  } catch (const cv::Exception& error) {
    throw std::runtime_error(file_ + ": OpenCV cannot run it: " + error.what());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file_ + ": " + error.what());
  }

 private:
  cv::dnn::Net load() const {
    cv::dnn::Net net = cv::dnn::readNetFromONNX(cut_.data(), cut_.size());
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    // OpenCV 4.6 merges what follows a matrix product into it and then forgets it: YOLO11's attention loses
    // its scale.
    net.enableFusion(!has_products_);
    return net;
  }

  cv::dnn::Net borrow() const {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        cv::dnn::Net net = std::move(idle_.back());
        idle_.pop_back();
        return net;
      }
    }
    return load();
  }

  /// OpenCV's name of a layer: with a prefix that depends on its version.
  static std::string layer_of(const cv::dnn::Net& net, const std::string& node) {
    for (const std::string& layer : net.getLayerNames())
      if (layer.ends_with(node)) return layer;
    throw std::runtime_error("OpenCV lost the output " + node);
  }

  std::vector<std::string> output_layers(const cv::dnn::Net& net) const {
    namespace name = onnx::output_name;
    return {layer_of(net, name::kBins), layer_of(net, shared_ ? name::kBins : name::kLogits),
            layer_of(net, name::kCoefficients), layer_of(net, name::kPrototypes)};
  }

  Prediction decoded(const std::vector<cv::Mat>& outputs) const {
    RawHead head{as_rows(outputs.at(0)), as_rows(outputs.at(1)), as_rows(outputs.at(2))};
    if (head.logits.rows < classes_)
      throw std::runtime_error("the class scores are not of the declared shape");
    head.logits = head.logits.rowRange(head.logits.rows - classes_, head.logits.rows);
    if (shared_) head.bins = head.bins.rowRange(0, head.bins.rows - classes_);
    const cv::Mat& prototypes = outputs.at(3);
    Prediction prediction;
    prediction.anchors = decode(head, input_size_);
    prediction.prototypes = as_rows(prototypes).clone();  // the net uses its memory again
    prediction.mask_size = {prototypes.size[3], prototypes.size[2]};
    return prediction;
  }

  std::string file_;
  int classes_;
  cv::Size input_size_;
  std::string cut_;            ///< the network in memory
  bool shared_ = false;        ///< bins and logits are one tensor
  bool has_products_ = false;  ///< of two matrices that are both computed
  mutable std::mutex mutex_;
  mutable std::vector<cv::dnn::Net> idle_;
};

}  // namespace

std::unique_ptr<Network> open_with_opencv(const onnx::Model& model, const onnx::Layout& layout,
                                          cv::Size input_size) try {
  return std::make_unique<OpenCvNetwork>(model, layout, input_size);
} catch (const cv::Exception& error) {
  throw std::runtime_error(model.file.string() + ": OpenCV cannot read it: " + error.what());
}

}  // namespace sediment::segment
