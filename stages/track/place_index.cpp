#include "stages/track/place_index.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sediment::track {
namespace {

constexpr int kTrunks = 32, kBranches = 32, kRounds = 6;
constexpr std::size_t kMostSamples = 20000;

__attribute__((target_clones("popcnt", "default"))) int nearest(const std::vector<Descriptor>& centres,
                                                                const Descriptor& descriptor) {
  int best = 0, least = 257;
  for (int i = 0; i < static_cast<int>(centres.size()); ++i) {
    const int distance = hamming_distance(centres[i], descriptor);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

Descriptor majority(const std::vector<Descriptor>& members) {
  Descriptor centre{};
  for (int bit = 0; bit < 256; ++bit) {
    std::size_t ones = 0;
    for (const Descriptor& member : members) ones += member[bit / 64] >> (bit % 64) & 1;
    if (2 * ones > members.size()) centre[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  return centre;
}

// k-majority: k-means on bits.
std::vector<Descriptor> centres_of(const std::vector<Descriptor>& samples, std::size_t count,
                                   std::mt19937& random) {
  std::vector<Descriptor> centres;
  for (std::size_t i = 0; i < std::min(count, samples.size()); ++i)
    centres.push_back(samples[random() % samples.size()]);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::vector<Descriptor>> members(centres.size());
    for (const Descriptor& sample : samples) members[nearest(centres, sample)].push_back(sample);
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (!members[i].empty()) centres[i] = majority(members[i]);
  }
  return centres;
}

}  // namespace

PlaceIndex::PlaceIndex(std::vector<const std::vector<Descriptor>*> places) {
  std::mt19937 random(20120520);
  std::vector<Descriptor> samples;
  std::size_t total = 0, at = 0;
  for (const auto* place : places) total += place->size();
  const std::size_t stride = total / kMostSamples + 1;
  for (const auto* place : places)
    for (const Descriptor& descriptor : *place)
      if (at++ % stride == 0) samples.push_back(descriptor);
  trunks_ = centres_of(samples, kTrunks, random);
  std::vector<std::vector<Descriptor>> parts(trunks_.size());
  for (const Descriptor& sample : samples) parts[nearest(trunks_, sample)].push_back(sample);
  int words = 0;
  for (const auto& part : parts) {
    first_word_.push_back(words);
    branches_.push_back(part.empty() ? std::vector<Descriptor>{Descriptor{}}
                                     : centres_of(part, kBranches, random));
    words += static_cast<int>(branches_.back().size());
  }
  std::vector<std::vector<std::pair<int, int>>> counts(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) { counts[i] = counted(*places[i]); });
  rarity_.assign(words, 0);
  for (const auto& place : counts)
    for (const auto& [word, count] : place) ++rarity_[word];
  for (double& rarity : rarity_) rarity = std::log((1 + static_cast<double>(places.size())) / (0.5 + rarity));
  for (const auto& place : counts) words_of_.push_back(weighted(place));
}

int PlaceIndex::word_of(const Descriptor& descriptor) const {
  const int trunk = nearest(trunks_, descriptor);
  return first_word_[trunk] + nearest(branches_[trunk], descriptor);
}

std::vector<std::pair<int, int>> PlaceIndex::counted(const std::vector<Descriptor>& descriptors) const {
  std::vector<int> words;
  for (const Descriptor& descriptor : descriptors) words.push_back(word_of(descriptor));
  std::sort(words.begin(), words.end());
  std::vector<std::pair<int, int>> counts;
  for (const int word : words)
    if (!counts.empty() && counts.back().first == word)
      ++counts.back().second;
    else
      counts.emplace_back(word, 1);
  return counts;
}

PlaceIndex::Words PlaceIndex::weighted(const std::vector<std::pair<int, int>>& counts) const {
  Words words;
  double sum = 0;
  for (const auto& [word, count] : counts) {
    words.push_back({word, count * rarity_[word]});
    sum += words.back().weight;
  }
  for (Weighted& word : words) word.weight /= sum;
  return words;
}

namespace {

// What two histograms have in common, 0 .. 1: one minus half their distance in the sum of magnitudes.
template <class Words>
double common(const Words& a, const Words& b) {
  double sum = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();)
    if (i->word < j->word)
      ++i;
    else if (j->word < i->word)
      ++j;
    else
      sum += std::min((i++)->weight, (j++)->weight);
  return sum;
}

}  // namespace

std::vector<PlaceIndex::Place> PlaceIndex::similar(const std::vector<Descriptor>& descriptors) const {
  const Words words = weighted(counted(descriptors));
  std::vector<Place> places;
  for (std::size_t i = 0; i < words_of_.size(); ++i)
    if (const double similarity = common(words, words_of_[i]); similarity > 0)
      places.push_back({static_cast<int>(i), similarity});
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.similarity > b.similarity; });
  return places;
}

double PlaceIndex::similarity(int first_idx, int second_idx) const {
  return common(words_of_[first_idx], words_of_[second_idx]);
}

}  // namespace sediment::track
