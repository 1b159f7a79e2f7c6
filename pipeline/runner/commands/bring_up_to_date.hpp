#pragma once

#include "pipeline/runner/commands/arguments.hpp"

namespace sediment::runner {

/// What became of a run.
struct Ran {
  int code;          ///< exit code
  bool is_complete;  ///< nothing is left to a batch system that goes on without us
};

/// What `run` and `sweep` do.
Ran bring_up_to_date(const Arguments& arguments);

}  // namespace sediment::runner
