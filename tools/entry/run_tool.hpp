#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace sediment::tools {

/// Parses the flags, runs the body and returns the exit code of the program: 0 done, 1 the work failed, 2 the
/// call is wrong (contract::UsageError too). Errors go to stderr, `--help` to stdout.
int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

}  // namespace sediment::tools
