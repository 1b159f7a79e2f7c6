#include <iostream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"

int main(int argc, char** argv) try {
  const auto arguments = sediment::runner::parse_arguments(argc, argv);
  return arguments ? arguments->command->carry_out(*arguments) : sediment::contract::kDone;
} catch (const sediment::contract::UsageError& error) {
  std::cerr << "sediment: " << error.what() << '\n';
  return sediment::contract::kWrongCall;
} catch (const std::exception& error) {
  std::cerr << "sediment: " << error.what() << '\n';
  return sediment::contract::kFailed;
}
