// coco-masks: masks to and from COCO's JSON format, which annotation tools and evaluations of segmentation
// read.
#include <CLI/CLI.hpp>

#include "tools/coco-masks/coco_conversion.hpp"
#include "tools/entry/run_tool.hpp"

using namespace sediment;

int main(int argc, char** argv) {
  CLI::App app("Converts masks to and from COCO's JSON format.", "coco-masks");
  std::filesystem::path from, to;
  auto* exporting = app.add_subcommand("export", "masks artifact (a result of segment) to a COCO file");
  exporting->add_option("MASKS", from, "folder with masks/ and instances.json")->required();
  exporting->add_option("FILE", to, "COCO file to write")->required();
  auto* importing = app.add_subcommand("import", "COCO file (polygons or run lengths) to a masks artifact");
  importing->add_option("FILE", from, "COCO file")->required();
  importing->add_option("MASKS", to, "folder to write; must not exist or be empty")->required();
  app.require_subcommand(1);
  return tools::run_tool(app, argc, argv, [&] {
    if (exporting->parsed())
      tools::export_coco(from, to);
    else
      tools::import_coco(from, to);
  });
}
