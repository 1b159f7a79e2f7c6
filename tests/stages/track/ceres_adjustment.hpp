#pragma once

#include "stages/track/bundle_adjustment.hpp"

namespace sediment::track::test {

/// The same as adjust(), solved by Ceres to its end: what adjust() is compared with.
double adjust_with_ceres(Bundle& bundle, const Pinhole& pinhole, const AdjustmentRule& rule);

}  // namespace sediment::track::test
