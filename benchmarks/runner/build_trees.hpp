#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sediment::benchmark {

/// A folder with the same work for every runner: sources (data/), the trivial stage under the name of every
/// step (bin/), and the files that say what is to be done: pipeline.yaml and sweep.yaml, build.ninja,
/// Makefile, Snakefile.
struct Tree {
  std::filesystem::path folder;
  int chains = 0, steps = 0;
  int sources_per_chain = 1;  ///< more than one: a folder of files, of which every step reads all
};

/// Every chain is step1 -> ... -> stepN, from a text of its own.
Tree write_chains(const std::filesystem::path& folder, int chains, int steps);

/// Steps that all read the same folder of files and nothing else.
Tree write_wide(const std::filesystem::path& folder, int files, int steps);

/// Gives the step of every chain a number, and that of the last chain one of its own.
void set_numbers(const Tree& tree, int step, int number, int last);

/// Removes all results, so that the next call begins from nothing.
void remove_results(const Tree& tree);

/// The call of a runner ("sediment", "ninja", "make", "snakemake").
std::vector<std::string> call_of(const std::string& runner, const std::filesystem::path& folder, int jobs);

}  // namespace sediment::benchmark
