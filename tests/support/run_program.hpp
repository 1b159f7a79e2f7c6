#pragma once

#include <string>

namespace sediment::test {

/// How a program of ours ended, and what it said on stdout and stderr together.
struct Outcome {
  int code = 0;
  std::string output;
};

/// Runs a program of this build by its name: run_program("fuse", "--sequence 'a b.yaml' --out x").
Outcome run_program(const std::string& name, const std::string& arguments);

}  // namespace sediment::test
