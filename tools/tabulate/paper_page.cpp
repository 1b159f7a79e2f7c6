#include "tools/tabulate/paper_tables.hpp"

namespace sediment::tabulate {

std::string paper_page(const PaperTables& tables, const std::string& chart) {
  std::string text = "## Sizes of the maps\n\nMB = 10^6 bytes of the file. Ours: " + tables.settings +
                     ". The paper says neither its encoding, fields nor whether MB are 10^6 or 2^20 bytes: "
                     "ratios are the fair comparison.\n\n" +
                     to_markdown(tables.sizes) + "\n![Sizes of the maps](" + chart + ")\n";
  if (!tables.missing.empty()) {
    text += "\nMissing, because no folder of the recording was given:";
    for (std::size_t i = 0; i < tables.missing.size(); ++i) text += (i ? ", " : " ") + tables.missing[i];
    text += ".\n";
  }
  text += "\n## What SOR removes\n\n" + to_markdown(tables.sor);
  text +=
      "\n## Which settings give the paper's ratios\n\nShare of the dense cloud [%] that SOR and the voxel "
      "filter leave, over the side of a "
      "voxel and the frames that are fused. Bold: within 3 points of the paper's ratio for that sequence, "
      "or, for a recording that is not "
      "the paper's, within its band of 18 to 50 %.\n\n" +
      to_markdown(tables.leaf_band) +
      "\nSize of map.ot as a share of the dense cloud [%], over the side of a voxel and the octree's "
      "resolution. Bold: within the paper's "
      "16.5 to 35 %.\n\n" +
      to_markdown(tables.tree_band);
  return text;
}

}  // namespace sediment::tabulate
