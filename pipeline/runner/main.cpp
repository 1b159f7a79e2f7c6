#include <iostream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/commands.hpp"

int main(int argc, char** argv) try {
  using namespace sediment::runner;
  const auto arguments = parse_arguments(argc, argv);
  if (!arguments) return sediment::contract::kDone;
  if (arguments->command == "run") return run(*arguments);
  if (arguments->command == "plan") return show_plan(*arguments);
  if (arguments->command == "why") return show_why(*arguments);
  if (arguments->command == "graph") return show_graph(*arguments);
  if (arguments->command == "verify") return verify_store(*arguments);
  return show_status(*arguments);
} catch (const sediment::contract::UsageError& error) {
  std::cerr << "sediment: " << error.what() << '\n';
  return sediment::contract::kWrongCall;
} catch (const std::exception& error) {
  std::cerr << "sediment: " << error.what() << '\n';
  return sediment::contract::kFailed;
}
