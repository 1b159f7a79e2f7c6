// report: one page (HTML, self-contained) to look at a run or a sweep. `sediment report FOLDER` calls it with
// what the runner knows; it adds what the artifacts hold.
#include <CLI/CLI.hpp>
#include <iostream>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tools/entry/run_tool.hpp"
#include "tools/report/instance_part.hpp"

using namespace sediment;

namespace {

report::Json read_facts(const std::filesystem::path& file) {
  try {
    report::Json facts = report::Json::parse(read_bytes(file));
    if (facts.at("format") != "sediment-report-facts 1")
      throw std::runtime_error("unknown format " + facts.at("format").dump());
    return facts;
  } catch (const report::Json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "One page to look at a run or a sweep: `sediment report FOLDER` calls this with the facts it needs.",
      "report");
  std::filesystem::path file, out;
  report::Budget budget;
  app.add_option("FACTS", file, "what the runner knows of the run (JSON)")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--out", out, "page to write")->required()->type_name("HTML");
  app.add_option("--points", budget.points, "points on the whole page; clouds with more are thinned")
      ->capture_default_str();
  app.add_option("--boxes", budget.boxes, "octree boxes on the whole page; larger trees are shown coarser")
      ->capture_default_str();
  app.add_option("--frames", budget.frames, "pictures on the whole page")->capture_default_str();
  return tools::run_tool(app, argc, argv, [&] {
    report::Json facts = read_facts(file);
    report::Page page;
    report::add_artifacts(facts, budget, page);
    page.write(out, facts);
    char size[32];
    std::snprintf(size, sizeof size, "%.1f", static_cast<double>(std::filesystem::file_size(out)) / 1e6);
    std::cout << out.string() << ": " << facts["instances"].size() << " instances, " << size << " MB\n";
    for (const report::Json& instance : facts["instances"])
      for (const report::Json& one : instance["not_shown"])
        std::cout << "not shown: " << instance["name"].get<std::string>() << ' '
                  << one["part"].get<std::string>() << ": " << one["why"].get<std::string>() << '\n';
  });
}
