#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/frame.hpp"
#include "stages/segment/parameters.hpp"

namespace sediment::segment {

/// Where the masks of a sequence come from: a network or files.
class MaskSource {
 public:
  MaskSource() = default;
  virtual ~MaskSource() = default;
  MaskSource(const MaskSource&) = delete;
  MaskSource& operator=(const MaskSource&) = delete;

  /// Safe to call from several threads and in any order. Throws std::runtime_error that names the file.
  virtual InstanceMask masks_of(std::size_t frame_idx) const = 0;
  /// "onnxruntime", "opencv" or "given".
  virtual std::string engine() const = 0;
  /// Seconds spent in the network by all threads together; 0 without one.
  virtual double inference_s() const { return 0; }
  /// Frames for which no mask was given, taken as empty.
  virtual std::size_t missing() const { return 0; }
};

/// The engine that the parameters and the inputs ask for; the sequence must outlive it. Throws
/// contract::UsageError if they contradict each other, std::runtime_error if model or masks cannot be used.
std::unique_ptr<MaskSource> open_source(const Parameters& parameters, const Sequence& sequence,
                                        const std::optional<std::filesystem::path>& model,
                                        const std::optional<std::filesystem::path>& masks);

}  // namespace sediment::segment
