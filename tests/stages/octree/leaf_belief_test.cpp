#include "stages/octree/leaf_belief.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace sediment;
using namespace sediment::octree;

namespace {

std::vector<LeafPoint> points(std::initializer_list<std::pair<std::uint32_t, int>> counts) {
  std::vector<LeafPoint> all;
  for (const auto& [label, count] : counts)
    for (int i = 0; i < count; ++i) all.push_back({.label = label});
  return all;
}

}  // namespace

TEST_CASE("by majority a leaf has the labels of most points, with their shares") {
  const auto beliefs = label_beliefs(points({{7, 2}, {56, 5}, {kUnlabelled, 2}, {3, 1}}), {});
  CHECK(beliefs[0].label == 56);
  CHECK(beliefs[0].confidence == Approx(0.5));
  CHECK(beliefs[1].label == 7);
  CHECK(beliefs[2].label == kUnlabelled);
  CHECK(beliefs[2].confidence == Approx(0.2));
  CHECK(label_beliefs(points({{9, 3}}), {})[0].confidence == 1);
  CHECK(label_beliefs({}, {})[0].label == kUnlabelled);
}

TEST_CASE("Bayes' rule gives the posterior of few points exactly") {
  const LabelParameters parameters{LabelFusion::bayes, 0.4, 0.05};
  // One chair, two unlabelled. chair: 0.55 * 0.4^2; nothing: 0.05 * 0.95^2.
  const auto beliefs = label_beliefs(points({{56, 1}, {kUnlabelled, 2}}), parameters);
  const double chair = 0.55 * 0.16, nothing = 0.05 * 0.95 * 0.95;
  CHECK(beliefs[0].label == 56);
  CHECK(beliefs[0].confidence == Approx(chair / (chair + nothing)));
  CHECK(beliefs[1].label == kUnlabelled);
  CHECK(beliefs[1].confidence == Approx(nothing / (chair + nothing)));
  CHECK(beliefs[2].confidence == 0);
}

TEST_CASE(
    "a class that the network misses in half of the frames wins by Bayes' rule, a stray label does not") {
  const LabelParameters parameters{LabelFusion::bayes, 0.4, 0.05};
  CHECK(label_beliefs(points({{56, 45}, {kUnlabelled, 55}}), parameters)[0].label == 56);
  CHECK(label_beliefs(points({{56, 10}, {kUnlabelled, 90}}), parameters)[0].label == kUnlabelled);
  CHECK(label_beliefs(points({{56, 45}, {kUnlabelled, 55}}), {})[0].label == kUnlabelled);
  CHECK(label_beliefs(points({{kUnlabelled, 55}}), parameters)[0].confidence == 1);
}

TEST_CASE("many points of one leaf count as at most eight observations") {
  const LabelParameters parameters{LabelFusion::bayes, 0.4, 0.05};
  const auto few = label_beliefs(points({{56, 6}, {57, 2}}), parameters);
  const auto many = label_beliefs(points({{56, 600}, {57, 200}}), parameters);
  CHECK(many[0].confidence == Approx(few[0].confidence));
  CHECK(many[0].confidence == Approx(1 / (1 + std::pow(0.05 / 0.55, 4))).epsilon(1e-3));
}
