#pragma once

#include "tools/report/page.hpp"

namespace sediment::report {

/// How much of a page each instance may take.
struct Budget {
  std::size_t points = 400'000;  ///< of all clouds on the page
  std::size_t boxes = 80'000;    ///< of all octrees on the page
  std::size_t frames = 60;       ///< pictures on the page
};

/// Adds to every instance of the facts (pipeline/runner/commands/report_command.cpp) what its artifacts show:
/// trajectory, frames, interactions, clouds, octree, grid. What cannot be read is no error: it stands in
/// `not_shown` with the reason, because the rest of the page is worth having.
void add_artifacts(Json& facts, const Budget& budget, Page& page);

}  // namespace sediment::report
