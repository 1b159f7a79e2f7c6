#include "stages/octree/leaf_belief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sediment::octree {
namespace {

struct Hypothesis {
  std::uint32_t label = kUnlabelled;
  double points = 0;
  double weight = 0;  ///< not normalised
};

/// In the order of the labels.
std::vector<Hypothesis> count_labels(std::span<const LeafPoint> points) {
  std::vector<Hypothesis> counts;
  for (const LeafPoint& point : points) {
    const auto at =
        std::lower_bound(counts.begin(), counts.end(), point.label,
                         [](const Hypothesis& h, std::uint32_t label) { return h.label < label; });
    if (at != counts.end() && at->label == point.label)
      ++at->points;
    else
      counts.insert(at, {point.label, 1, 0});
  }
  return counts;
}

double log_likelihood(std::uint32_t seen, std::uint32_t truth, const LabelParameters& parameters) {
  if (truth == kUnlabelled) return std::log(seen == kUnlabelled ? 1 - parameters.wrong : parameters.wrong);
  if (seen == kUnlabelled) return std::log(parameters.missed);
  return std::log(seen == truth ? 1 - parameters.missed - parameters.wrong : parameters.wrong);
}

void weigh_by_bayes(std::vector<Hypothesis>& hypotheses, double points, const LabelParameters& parameters) {
  if (std::none_of(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& h) { return h.label == kUnlabelled; }))
    hypotheses.push_back({});
  const double scale = std::min(1.0, kIndependent / points);
  double highest = -std::numeric_limits<double>::infinity();
  for (Hypothesis& truth : hypotheses) {
    for (const Hypothesis& seen : hypotheses)
      if (seen.points > 0)
        truth.weight += scale * seen.points * log_likelihood(seen.label, truth.label, parameters);
    highest = std::max(highest, truth.weight);
  }
  for (Hypothesis& truth : hypotheses) truth.weight = std::exp(truth.weight - highest);
}

}  // namespace

std::array<LabelBelief, 3> label_beliefs(std::span<const LeafPoint> points,
                                         const LabelParameters& parameters) {
  const auto has_label = [](std::uint32_t label) {
    return [label](const LeafPoint& point) { return point.label == label; };
  };
  if (points.empty()) return {};
  // Most leaves have one label only.
  if (const std::uint32_t first = points.front().label;
      (first == kUnlabelled || parameters.fusion == LabelFusion::majority) &&
      std::all_of(points.begin(), points.end(), has_label(first)))
    return {{{first, 1}}};
  std::vector<Hypothesis> hypotheses = count_labels(points);
  if (parameters.fusion == LabelFusion::bayes)
    weigh_by_bayes(hypotheses, static_cast<double>(points.size()), parameters);
  else
    for (Hypothesis& hypothesis : hypotheses) hypothesis.weight = hypothesis.points;
  double sum = 0;
  for (const Hypothesis& hypothesis : hypotheses) sum += hypothesis.weight;
  std::sort(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.label < b.label;
  });
  std::array<LabelBelief, 3> beliefs{};
  for (std::size_t i = 0; i < std::min(beliefs.size(), hypotheses.size()); ++i)
    beliefs[i] = {hypotheses[i].label, static_cast<float>(hypotheses[i].weight / sum)};
  return beliefs;
}

}  // namespace sediment::octree
