#include "tools/tabulate/paper_figures.hpp"

namespace sediment::tabulate {

std::optional<double> PaperSequence::ratio() const {
  if (!dense_mb || !reduced_mb) return std::nullopt;
  return *reduced_mb / *dense_mb;
}

std::span<const PaperSequence> paper_sequences() {
  static const PaperSequence kSequences[] = {
      {"freiburg2_rpy", "fr2/rpy", 13.3, 2.4},
      {"freiburg2_desk_with_person", "fr2/desk/p", 31.3, 5.7},
      {"freiburg3_sitting_halfsphere", "fr3/s/half", 21.1, 4.3},
      {"freiburg3_sitting_static", "fr3/s/static", 0.6, 0.3},
      {"freiburg3_walking_halfsphere", "fr3/w/half", 15.1, 4.6},
      {"freiburg3_walking_rpy", "fr3/w/rpy", 19.3, 7.6},
      {"freiburg3_walking_static", "fr3/w/static", 8.1, 2.1},
      {"freiburg3_walking_xyz", "fr3/w/xyz", std::nullopt, std::nullopt},
  };
  return kSequences;
}

const PaperSequence* paper_sequence(const std::string& name) {
  for (const PaperSequence& one : paper_sequences())
    if (name == one.name || name == std::string("rgbd_dataset_") + one.name) return &one;
  return nullptr;
}

}  // namespace sediment::tabulate
