#pragma once

#include <span>

#include "tools/tabulate/bar_chart.hpp"
#include "tools/tabulate/run_facts.hpp"
#include "tools/tabulate/table.hpp"

namespace sediment::tabulate {

/// The tables of the paper on file sizes, made from sweeps over voxel.leaf, octree.resolution_m and the
/// frames of fuse.
struct PaperTables {
  Table sizes;      ///< a sequence a row, at the settings of the pipeline, the paper's figures beside ours
  Table sor;        ///< what SOR removes, beside the paper's 1.24 %
  Table leaf_band;  ///< share of the dense cloud that is left, over keyframe density and voxel size
  Table tree_band;  ///< the same of map.ot, over voxel size and resolution
  Table receipts;   ///< where each figure comes from
  std::vector<BarGroup> chart;       ///< Figure 21
  std::vector<std::string> missing;  ///< sequences of the paper that no instance is of
  std::string settings;              ///< parameters and encoding of `sizes`, in words
};

/// `base`: the sequences at the settings of the pipeline; `bands`: sweeps over the parameters that the paper
/// does not give. Throws std::runtime_error if no instance has a result of fuse, sor, voxel and octree.
PaperTables paper_tables(std::span<const RunFacts> base, std::span<const RunFacts> bands);

/// All of it as one page in Markdown. `chart`: file of the picture, as the page refers to it.
std::string paper_page(const PaperTables& tables, const std::string& chart);

}  // namespace sediment::tabulate
