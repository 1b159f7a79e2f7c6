#include "stages/fuse/covered_cells.hpp"

#include <catch2/catch.hpp>

using namespace sediment;
using namespace sediment::fuse;

namespace {

LabelledPoint at(float x, float y, float z) {
  return {.x = x, .y = y, .z = z};
}

}  // namespace

TEST_CASE(
    "only points with no earlier one in their cell or the 26 around it are new, and then they are known") {
  CoveredCells covered(0.1);
  covered.add({at(0.05F, 0.05F, 0.05F)});
  LabelledCloud points{at(0.01F, 0.01F, 0.01F), at(-0.01F, 0.15F, 0.19F), at(0.25F, 0.05F, 0.05F),
                       at(-0.11F, 0.05F, 0.05F), at(0.26F, 0.05F, 0.05F)};
  const LabelledCloud expected{points[2], points[3], points[4]};  // two of one cell of one frame: both
  covered.keep_new(points);
  CHECK(points == expected);
  covered.keep_new(points);
  CHECK(points.empty());
}
