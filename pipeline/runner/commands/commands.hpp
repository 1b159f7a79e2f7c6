#pragma once

#include "pipeline/runner/commands/arguments.hpp"

namespace sediment::runner {

/// Each returns the exit code.
int run(const Arguments& arguments);
int show_plan(const Arguments& arguments);
int show_why(const Arguments& arguments);
int show_graph(const Arguments& arguments);
int show_status(const Arguments& arguments);
int verify_store(const Arguments& arguments);

}  // namespace sediment::runner
