#pragma once

#include "stages/segment/mask_source.hpp"

namespace sediment::segment {

/// Masks from a network on `engine` (onnxruntime or opencv). Throws as open_source().
std::unique_ptr<MaskSource> open_network_source(const Parameters& parameters, Engine engine,
                                                const Sequence& sequence, const std::filesystem::path& model);

}  // namespace sediment::segment
