#pragma once

#include "stages/segment/mask_source.hpp"

namespace sediment::segment {

/// Masks from files. Throws as open_source().
std::unique_ptr<MaskSource> open_given_source(const Parameters& parameters, const Sequence& sequence,
                                              const std::filesystem::path& masks);

}  // namespace sediment::segment
