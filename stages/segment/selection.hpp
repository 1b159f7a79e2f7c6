#pragma once

#include <string>
#include <vector>

#include "stages/segment/detections.hpp"
#include "stages/segment/parameters.hpp"

namespace sediment::segment {

/// What the parameters select among the classes of a network. Throws contract::UsageError for a class that
/// the network does not have ("did you mean"), and for an entry of class_confidence that is not
/// `name=number`.
Selection select(const Parameters& parameters, const std::vector<std::string>& class_names);

}  // namespace sediment::segment
