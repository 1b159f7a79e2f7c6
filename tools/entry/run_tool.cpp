#include "tools/entry/run_tool.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "pipeline/contract/errors.hpp"

namespace sediment::tools {

int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
  try {
    app.parse(argc, argv);
    body();
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("cannot write to the standard output");
    return contract::kDone;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    std::cerr << app.get_name() << ": " << error.what() << " (--help explains)\n";
    return contract::kWrongCall;
  } catch (const contract::UsageError& error) {
    std::cerr << app.get_name() << ": " << error.what() << " (--help explains)\n";
    return contract::kWrongCall;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << "\n";
    return contract::kFailed;
  }
}

}  // namespace sediment::tools
