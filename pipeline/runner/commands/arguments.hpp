#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sediment::runner {

/// A call of `sediment`, understood.
struct Arguments {
  std::string command;  ///< run, plan, why, graph, status
  std::filesystem::path config;
  std::string stage;  ///< of why, may be empty
  std::string only, from, until;
  std::vector<std::string> set;
  std::vector<std::string> resources;        ///< what this machine has, name=amount
  std::filesystem::path out, store, stages;  ///< empty: their defaults
  int jobs = 0;                              ///< 0 = one per core
  int threads = 0;                           ///< 0 = all cores
  bool keep_going = false, rehash = false, durable = false, no_space_check = false, json = false;
  double share = 1;             ///< of verify
  std::string format = "text";  ///< of graph
};

/// Answers --help and --version itself: then there is nothing left to do. Throws contract::UsageError.
std::optional<Arguments> parse_arguments(int argc, char** argv);

}  // namespace sediment::runner
