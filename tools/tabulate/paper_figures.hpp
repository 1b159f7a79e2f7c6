#pragma once

#include <optional>
#include <span>
#include <string>

namespace sediment::tabulate {

/// A sequence whose file sizes the paper gives (section 4.4, "comparison of map file sizes"), or maps without
/// giving them. Megabytes as printed there; the paper does not say whether they are 10^6 or 2^20 bytes.
struct PaperSequence {
  const char* name;   ///< as the benchmark's folders are called, without rgbd_dataset_
  const char* shown;  ///< as the paper calls it
  std::optional<double> dense_mb, reduced_mb;

  std::optional<double> ratio() const;
};

/// The eight sequences of the paper.
std::span<const PaperSequence> paper_sequences();

/// The one that a folder or sequence file is named after, nullptr if it is none of the paper's.
const PaperSequence* paper_sequence(const std::string& name);

/// What the paper says of all sequences together.
struct PaperBands {
  double reduced_low = 0.18, reduced_high = 0.50;  ///< its own values; the text says 20-50 %
  double octree_low = 0.165, octree_high = 0.35;   ///< of the dense cloud
  double sor_removed = 0.0124;                     ///< of the points
};

}  // namespace sediment::tabulate
