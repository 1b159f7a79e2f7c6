// tabulate: tables from sweeps, for papers and for comparison.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <set>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tools/entry/run_tool.hpp"
#include "tools/tabulate/evaluation_table.hpp"
#include "tools/tabulate/paper_tables.hpp"

using namespace sediment;
using namespace sediment::tabulate;
namespace fs = std::filesystem;

namespace {

struct Call {
  std::vector<fs::path> facts, bands;
  std::string out;
};

std::vector<RunFacts> read_all(const std::vector<fs::path>& files) {
  std::vector<RunFacts> all;
  for (const fs::path& file : files) all.push_back(read_run_facts(file));
  return all;
}

void write_table(const std::string& base, const Table& table) {
  write_bytes(base + ".md", {to_markdown(table)});
  write_bytes(base + ".csv", {to_csv(table)});
  write_bytes(base + ".tex", {to_latex(table)});
}

/// "ablation/1_no_masks.data.json": 1_no_masks.
std::string sweep_of(const fs::path& file) {
  const std::string name = file.filename();
  return name.substr(0, name.find('.'));
}

/// All instances as those of one sweep; which file they came from is an axis if the files are of several
/// sweeps.
RunFacts together(const std::vector<fs::path>& files) {
  std::set<std::string> sweeps;
  for (const fs::path& file : files) sweeps.insert(sweep_of(file));
  RunFacts all;
  if (sweeps.size() > 1) all.axes.push_back("sweep");
  for (const fs::path& file : files) {
    RunFacts facts = read_run_facts(file);
    for (const std::string& axis : facts.axes)
      if (std::find(all.axes.begin(), all.axes.end(), axis) == all.axes.end()) all.axes.push_back(axis);
    for (InstanceFacts& one : facts.instances) {
      if (sweeps.size() > 1) one.values["sweep"] = sweep_of(file);
      all.instances.push_back(std::move(one));
    }
    all.name = facts.name;
  }
  return all;
}

void tabulate_evaluation(const Call& call) {
  const EvaluationTables tables = evaluation_tables(together(call.facts));
  write_table(call.out, tables.each);
  write_table(call.out + "_summary", tables.summary);
  std::cout << to_markdown(tables.each) << "\nMedian over the sequences (least to most)\n\n"
            << to_markdown(tables.summary);
}

void tabulate_paper(const Call& call) {
  const auto base = read_all(call.facts), bands = read_all(call.bands);
  const PaperTables tables = paper_tables(base, bands);
  write_bytes(call.out + "_sizes.svg", {bar_chart(tables.chart, "Sizes of the maps", "MB")});
  write_table(call.out + "_sizes", tables.sizes);
  write_bytes(call.out + "_receipts.csv", {to_csv(tables.receipts)});
  std::cout << paper_page(tables, fs::path(call.out + "_sizes.svg").filename());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tables from what `sediment report FOLDER --facts FILE` wrote of one or more sweeps.",
               "tabulate");
  Call call;
  app.require_subcommand(1);
  CLI::App* evaluation = app.add_subcommand(
      "evaluation", "errors, coverage, map quality, sizes, time and memory of every instance, and medians");
  CLI::App* paper = app.add_subcommand("paper", "the paper's tables of file sizes, as one page in Markdown");
  for (CLI::App* sub : {evaluation, paper}) {
    sub->add_option("FACTS", call.facts, "facts of sweeps")->required()->check(CLI::ExistingFile);
    sub->add_option("--out", call.out, "where the tables go: BASE.md, BASE.csv, BASE.tex, ...")
        ->required()
        ->type_name("BASE");
  }
  paper->add_option("--band", call.bands, "facts of sweeps over the parameters that the paper does not give")
      ->check(CLI::ExistingFile);
  return tools::run_tool(app, argc, argv,
                         [&] { evaluation->parsed() ? tabulate_evaluation(call) : tabulate_paper(call); });
}
