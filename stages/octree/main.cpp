#include <octomap/ColorOcTree.h>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/octree/build_tree.hpp"
#include "stages/octree/cast_sequence.hpp"

using namespace sediment;
using namespace sediment::octree;

namespace {

struct RayChoice {
  RayParameters rays;
  int every_nth = 1;
  Occupied occupied = Occupied::by_cloud;
};

void declare_labels(contract::Stage& stage, LabelParameters& labels) {
  stage.tunes("label_fusion", labels.fusion, "label of a leaf: most of its points, or Bayes' rule",
              {{"majority", LabelFusion::majority}, {"bayes", LabelFusion::bayes}});
  stage.tunes("label_missed", labels.missed,
              "bayes: probability that a point of a class is left unlabelled by the network", {0.001, 0.9});
  stage.tunes("label_wrong", labels.wrong, "bayes: probability that a point bears one particular wrong label",
              {0.001, 0.09});
}

void declare_rays(contract::Stage& stage, RayChoice& choice) {
  stage.tunes("occupied", choice.occupied,
              "what says that a leaf is occupied: cloud, or rays (OctoMap's insertion of all frames)",
              {{"cloud", Occupied::by_cloud}, {"rays", Occupied::by_rays}});
  stage.tunes("every_nth", choice.every_nth, "every n-th frame casts rays", {1, 1e6});
  stage.tunes("ray_min_m", choice.rays.min_depth_m, "nearer depths cast no ray", {0, 1000});
  stage.tunes("ray_max_m", choice.rays.max_depth_m, "depth up to which rays go", {0.01, 1000});
  stage.tunes("ray_step", choice.rays.pixel_step, "every n-th pixel of every n-th row casts a ray",
              {1, 1000});
}

/// What the rays of the sequence say; nothing if there is no sequence.
std::vector<SpaceCell> cast(contract::Work& work, const RayChoice& choice, const Parameters& parameters) {
  if (!work.has("sequence")) return {};
  const Sequence sequence = Sequence::open(work.in("sequence"));
  const Trajectory trajectory = read_trajectory(work.in("trajectory"));
  std::optional<DynamicMasksReader> dynamic;
  if (work.has("dynamic")) dynamic.emplace(work.in("dynamic"));
  const auto step = static_cast<std::size_t>(choice.every_nth);
  contract::Progress progress("octree", (sequence.size() + step - 1) / step, "frames");
  RayMap map(octomap::ColorOcTree(parameters.resolution_m));
  const CastCounts counts = cast_sequence(
      sequence, trajectory, dynamic, choice.every_nth, choice.rays, parameters.resolution_m,
      2 * static_cast<std::size_t>(work.threads()), [&] { progress.advance(); }, map);
  work.metrics()["frames_cast"] = counts.frames;
  work.metrics()["frames_without_pose"] = counts.frames_without_pose;
  const std::vector<SpaceCell> cells = map.cells();
  return choice.occupied == Occupied::by_rays ? cells : free_cells(cells, parameters.max_depth);
}

void check_inputs(const contract::Work& work, const RayChoice& choice) {
  if (work.has("sequence") != work.has("trajectory"))
    throw contract::UsageError("rays need both --sequence and --trajectory");
  if (work.has("dynamic") && !work.has("sequence"))
    throw contract::UsageError("--dynamic is of the rays: it needs --sequence and --trajectory");
  if (choice.occupied == Occupied::by_rays && !work.has("sequence"))
    throw contract::UsageError("occupied = rays needs --sequence and --trajectory");
  if (!(choice.rays.min_depth_m < choice.rays.max_depth_m))
    throw contract::UsageError("ray_min_m must be below ray_max_m");
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  RayChoice choice;
  contract::Stage stage("octree", "Semantic octree of the occupied and, from rays, the free space");
  stage.reads("cloud", contract::kind::kCloud, "points of the map");
  stage.reads_optional("sequence", contract::kind::kSequence, "depth images whose rays find free space");
  stage.reads_optional("trajectory", contract::kind::kTrajectory, "camera poses, in the world of the cloud");
  stage.reads_optional("dynamic", contract::kind::kDynamicMasks,
                       "what moves: its rays clear the way and fill nothing");
  stage.writes("octree", contract::kind::kOctree,
               "map.ot (colour), map.bt (occupancy), labels of the leaves");
  stage.tunes("resolution_m", parameters.resolution_m, "side of the smallest leaf", {0.001, 100});
  stage.tunes("max_depth", parameters.max_depth,
              "levels of the tree; each one less doubles the smallest leaf", {1, kTreeDepth});
  stage.tunes("color", parameters.color, "of the leaves: of their points, or of their label",
              {{"image", LeafColor::image}, {"label", LeafColor::label}});
  declare_labels(stage, parameters.labels);
  declare_rays(stage, choice);

  return stage.run(argc, argv, [&](contract::Work& work) {
    check_inputs(work, choice);
    const LabelledCloud cloud = read_cloud(work.in("cloud"));
    const LabelTable labels = read_cloud_labels(work.in("cloud"));
    const SortedPoints sorted = sort_into_leaves(cloud, parameters.resolution_m);
    if (sorted.points.empty())
      throw std::runtime_error(work.in("cloud").string() + ": no finite point among " +
                               std::to_string(cloud.size()));
    const std::vector<SpaceCell> cells = cast(work, choice, parameters);
    SemanticTree semantic = build_tree(sorted.points, cells, choice.occupied, parameters, labels);
    const std::size_t leaves = semantic.tree->getNumLeafNodes(), nodes = semantic.tree->size();
    write_octree(work.out(), *semantic.tree, semantic.leaf_labels, labels);
    work.metrics()["points"] = sorted.points.size();
    work.metrics()["points_not_finite"] = sorted.not_finite;
    work.metrics()["leaves"] = leaves;
    work.metrics()["leaves_occupied"] = semantic.leaf_labels.size();
    work.metrics()["nodes"] = nodes;
  });
}
