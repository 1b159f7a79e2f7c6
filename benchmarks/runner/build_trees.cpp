#include "benchmarks/runner/build_trees.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

namespace sediment::benchmark {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

/// The name of a result below out/.
std::string result_of(int chain, int step) {
  return fmt::format("out/{}/step{}/text.txt", chain, step);
}

void write_programs(const Tree& tree) {
  fs::create_directories(tree.folder / "bin");
  const fs::path stage = fs::read_symlink("/proc/self/exe").parent_path() / "trivial_stage";
  for (int step = 1; step <= tree.steps; ++step)
    fs::copy_file(stage, tree.folder / "bin" / fmt::format("step{}", step));
}

/// Nobody trusts a file that was changed within the last two seconds.
void let_age(const fs::path& folder) {
  const auto then = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const char* part : {"data", "bin"})
    for (const auto& entry : fs::recursive_directory_iterator(folder / part))
      fs::last_write_time(entry, then);
  sleep(3);  // the time of the last change of an entry cannot be set
}

void write_sweep(const Tree& tree, const std::string& more) {
  std::string text = "pipeline: pipeline.yaml\nover:\n  - sequence: [";
  for (int chain = 0; chain < tree.chains; ++chain)
    text += fmt::format("{}data/{}.txt", chain == 0 ? "" : ", ", chain);
  write(tree.folder / "sweep.yaml", text + "]\n" + more);
}

/// What step reads: the sources, or the step before it.
struct Rule {
  std::string in, out, program;
};

std::vector<Rule> rules_of(const Tree& tree, const std::string& first) {
  std::vector<Rule> rules;
  for (int chain = 0; chain < tree.chains; ++chain)
    for (int step = 1; step <= tree.steps; ++step) {
      const bool reads_sources = step == 1 || tree.sources_per_chain > 1;
      rules.push_back({reads_sources ? (first.empty() ? fmt::format("data/{}.txt", chain) : first)
                                     : result_of(chain, step - 1),
                       result_of(chain, step), fmt::format("bin/step{}", step)});
    }
  return rules;
}

void write_peers(const Tree& tree, const std::string& first) {
  std::string ninja = "rule step\n  command = $program --text $first --out $folder\n", make = "all:";
  const auto rules = rules_of(tree, first);
  for (const Rule& rule : rules) make += ' ' + rule.out;
  make += '\n';
  for (const Rule& rule : rules) {
    const std::string folder = fs::path(rule.out).parent_path();
    const std::string one = rule.in.substr(0, rule.in.find(' '));
    ninja += fmt::format("build {}: step {} | {}\n  program = {}\n  first = {}\n  folder = {}\n", rule.out,
                         rule.in, rule.program, rule.program, one, folder);
    make += fmt::format("{}: {} {}\n\t{} --text {} --out {}\n", rule.out, rule.in, rule.program, rule.program,
                        one, folder);
  }
  write(tree.folder / "build.ninja", ninja);
  write(tree.folder / "Makefile", make);
}

void write_snakemake(const Tree& tree) {
  std::string text = fmt::format("rule all:\n  input: expand(\"out/{{c}}/step{}/text.txt\", c=range({}))\n",
                                 tree.steps, tree.chains);
  for (int step = 1; step <= tree.steps; ++step)
    text += fmt::format(
        "rule step{0}:\n  input: \"{1}\"\n  output: \"out/{{c}}/step{0}/text.txt\"\n"
        "  shell: \"bin/step{0} --text {{input}} --out out/{{wildcards.c}}/step{0}\"\n",
        step, step == 1 ? "data/{c}.txt" : fmt::format("out/{{c}}/step{}/text.txt", step - 1));
  write(tree.folder / "Snakefile", text);
}

}  // namespace

Tree write_chains(const fs::path& folder, int chains, int steps) {
  const Tree tree{folder, chains, steps, 1};
  write_programs(tree);
  for (int chain = 0; chain < chains; ++chain)
    write(folder / fmt::format("data/{}.txt", chain), fmt::format("chain {}\n", chain));
  std::string pipeline = "sources: {sequence: {kind: file, path: data/0.txt}}\nstages:\n";
  for (int step = 1; step <= steps; ++step)
    pipeline += fmt::format("  step{}: {{reads: {{text: {}}}}}\n", step,
                            step == 1 ? "sequence" : fmt::format("step{}.text", step - 1));
  write(folder / "pipeline.yaml", pipeline);
  write_sweep(tree, "");
  write_peers(tree, "");
  write_snakemake(tree);
  remove_results(tree);
  let_age(folder);
  return tree;
}

Tree write_wide(const fs::path& folder, int files, int steps) {
  const Tree tree{folder, 1, steps, files};
  write_programs(tree);
  std::string all, color = "# stamp file\n";
  for (int file = 0; file < files; ++file) {
    const std::string name = fmt::format("rgb/{}.png", file);
    write(folder / "data" / name, name);
    all += fmt::format("{}data/{}", file == 0 ? "" : " ", name);
    color += fmt::format("{}.0 {}\n", file, name);
  }
  write(folder / "data/rgb.txt", color);
  write(folder / "data/sequence.yaml", "root: .\ncamera: {width: 4}\n");
  std::string pipeline = "sources: {sequence: {kind: sequence, path: data}}\nstages:\n";
  for (int step = 1; step <= steps; ++step)
    pipeline += fmt::format("  step{}: {{reads: {{text: sequence}}}}\n", step);
  write(folder / "pipeline.yaml", pipeline);
  write_peers(tree, all);
  remove_results(tree);
  let_age(folder);
  return tree;
}

void set_numbers(const Tree& tree, int step, int number, int last) {
  std::string numbers;
  for (int chain = 1; chain < tree.chains; ++chain) numbers += fmt::format("{}, ", number);
  write_sweep(tree, fmt::format("    step{}.number: [{}{}]\n", step, numbers, last));
}

void remove_results(const Tree& tree) {
  for (const char* part : {"out", "results", ".ninja_log", ".ninja_deps", ".snakemake"})
    fs::remove_all(tree.folder / part);
  // make makes no folders.
  for (int chain = 0; chain < tree.chains; ++chain)
    fs::create_directories(tree.folder / fmt::format("out/{}", chain));
  sync();
}

std::vector<std::string> call_of(const std::string& runner, const fs::path& folder, int jobs) {
  const std::string j = std::to_string(jobs);
  if (runner == "ninja" || runner == "make") return {runner, "-j" + j};
  if (runner == "snakemake") return {runner, "--cores", j, "--quiet"};
  const fs::path own = fs::read_symlink("/proc/self/exe").parent_path();
  const bool sweeps = fs::exists(folder / "sweep.yaml");
  return {own / "sediment",
          sweeps ? "sweep" : "run",
          sweeps ? "sweep.yaml" : "pipeline.yaml",
          "--stages",
          "bin",
          "--out",
          "results",
          "-j" + j};
}

}  // namespace sediment::benchmark
