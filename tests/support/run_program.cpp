#include "tests/support/run_program.hpp"

#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>

namespace sediment::test {

Outcome run_program(const std::string& name, const std::string& arguments) {
  const std::string command = "'" SEDIMENT_BINARY_DIR "/" + name + "' " + arguments + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  Outcome outcome;
  char text[4096];
  while (const std::size_t count = std::fread(text, 1, sizeof text, pipe)) outcome.output.append(text, count);
  outcome.code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

}  // namespace sediment::test
