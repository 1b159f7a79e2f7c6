#pragma once

#include <vector>

#include "stages/track/features.hpp"

namespace sediment::track {

/// Tells which places look alike, by the words of their descriptors (Sivic and Zisserman, ICCV 2003; binary
/// words as Galvez-Lopez and Tardos, T-RO 2012). The words are found in the recording itself, so there is no
/// vocabulary to load; the draw has a fixed seed.
class PlaceIndex {
 public:
  struct Place {
    int place_idx = 0;
    double similarity = 0;  ///< 0 .. 1
  };

  /// `places` must outlive it. At least one descriptor in all of them together.
  explicit PlaceIndex(std::vector<const std::vector<Descriptor>*> places);

  /// Places.
  std::size_t size() const { return words_of_.size(); }
  /// All places that share a word, most similar first, equal ones by index.
  std::vector<Place> similar(const std::vector<Descriptor>& descriptors) const;
  /// Similarity of two places of the index.
  double similarity(int first_idx, int second_idx) const;

 private:
  struct Weighted {
    int word = 0;
    double weight = 0;
  };
  using Words = std::vector<Weighted>;  ///< ascending by word, weights sum up to 1

  int word_of(const Descriptor& descriptor) const;
  std::vector<std::pair<int, int>> counted(const std::vector<Descriptor>& descriptors) const;
  Words weighted(const std::vector<std::pair<int, int>>& counts) const;

  std::vector<Descriptor> trunks_;                 ///< centres of the first level
  std::vector<std::vector<Descriptor>> branches_;  ///< per trunk: centres of the second
  std::vector<int> first_word_;                    ///< per trunk
  std::vector<double> rarity_;                     ///< per word: log(places / places that have it)
  std::vector<Words> words_of_;                    ///< per place
};

}  // namespace sediment::track
