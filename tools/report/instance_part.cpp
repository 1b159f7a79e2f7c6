#include "tools/report/instance_part.hpp"

#include <set>

#include "pipeline/artifacts/label_file.hpp"
#include "tools/report/parts.hpp"

namespace sediment::report {
namespace {

namespace fs = std::filesystem;

/// What an instance's stages made, by the kinds of their outputs.
struct Made {
  FrameFolders frames;
  std::vector<const Json*> clouds, octrees, grids, trajectories, interactions;
};

bool makes(const Json& stage, const std::string& kind) {
  for (const Json& output : stage.at("outputs"))
    if (output.at(1) == kind) return true;
  return false;
}

Made made_by(const Json& instance) {
  Made made;
  for (const Json& stage : instance.at("stages")) {
    for (const Json& input : stage.at("inputs")) {
      if (!input.contains("source") || input.at("role") != "sequence") continue;
      made.frames.sequence = input.at("source").get<std::string>();
      made.frames.sequence_id = input.at("id");
    }
    if (makes(stage, "masks")) {  // the last one: mended masks replace those of the network
      made.frames.masks = stage.at("folder").get<std::string>();
      made.frames.masks_id = stage.at("object");
    }
    if (makes(stage, "dynamic-masks")) {
      made.frames.dynamic = stage.at("folder").get<std::string>();
      made.frames.dynamic_id = stage.at("object");
      made.interactions.push_back(&stage);
    }
    if (makes(stage, "trajectory")) made.trajectories.push_back(&stage);
    if (makes(stage, "cloud")) made.clouds.push_back(&stage);
    if (makes(stage, "octree")) made.octrees.push_back(&stage);
    if (makes(stage, "grid-map")) made.grids.push_back(&stage);
  }
  return made;
}

/// Does what adds a part, or notes why it is not shown.
template <class Body>
void show(Json& instance, const std::string& part, Body body) {
  try {
    body();
  } catch (const std::exception& error) {
    instance["not_shown"].push_back({{"part", part}, {"why", error.what()}});
  }
}

std::string folder_of(const Json* stage) {
  return stage->at("folder");
}
std::string id_of(const Json* stage) {
  return stage->at("object");
}

/// Of several clouds the first and the last: all that was fused, and what is left of it.
std::vector<const Json*> shown_clouds(const Made& made, bool alone) {
  if (made.clouds.empty()) return {};
  if (made.clouds.size() == 1 || !alone) return {made.clouds.back()};
  return {made.clouds.front(), made.clouds.back()};
}

/// Everything that is drawn over the world of one instance.
void add_maps(Json& instance, const Made& made, const Budget& share, bool alone, Page& page) {
  const auto clouds = shown_clouds(made, alone);
  instance["clouds"] = Json::array();
  for (const Json* cloud : clouds)
    show(instance, "cloud of " + cloud->at("name").get<std::string>(), [&] {
      Json part = cloud_part(folder_of(cloud), id_of(cloud), share.points / clouds.size(), page);
      part["stage"] = cloud->at("name");
      instance["clouds"].push_back(std::move(part));
    });
  if (!made.octrees.empty())
    show(instance, "octree", [&] {
      instance["octree"] =
          octree_part(folder_of(made.octrees.back()), id_of(made.octrees.back()), share.boxes, page);
    });
  if (!made.grids.empty())
    show(instance, "grid map",
         [&] { instance["grid"] = grid_part(folder_of(made.grids.back()), id_of(made.grids.back()), page); });
}

void add_sequence(Json& instance, const Made& made, std::size_t frames, Page& page) {
  std::optional<Sequence> sequence;
  show(instance, "frames", [&] {
    const fs::path& path = made.frames.sequence;
    if (path.empty()) throw std::runtime_error("no stage of this run reads a sequence");
    sequence = Sequence::open(fs::is_directory(path) ? path / "sequence.yaml" : path);
    const Camera& camera = sequence->camera();
    instance["sequence"] = {
        {"file", path.string()}, {"frames", sequence->size()}, {"unassociated", sequence->unassociated()},
        {"width", camera.width}, {"height", camera.height},    {"fx", camera.fx},
        {"fy", camera.fy}};
    if (frames > 0) instance["frames"] = frames_part(*sequence, made.frames, frames, page);
  });
  if (!made.trajectories.empty())
    show(instance, "trajectory", [&] {
      const auto truth = sequence ? sequence->groundtruth() : std::nullopt;
      instance["trajectory"] =
          trajectory_part(folder_of(made.trajectories.back()), truth.value_or(fs::path()));
    });
  if (!made.interactions.empty())
    show(instance, "interactions",
         [&] { instance["interactions"] = interactions_part(folder_of(made.interactions.back())); });
}

Json shown_labels() {
  Json labels = Json::object();
  for (const Label& label : default_labels().labels())
    labels[label.name] = {{"rgb", label.rgb}, {"dynamic", label.prior_dynamic}};
  return labels;
}

}  // namespace

void add_artifacts(Json& facts, const Budget& budget, Page& page) {
  Json& instances = facts.at("instances");
  const Json made_from = facts.at("instances");  // the parts below hold pointers into it
  std::vector<Made> made;
  std::set<std::string> pictures, clouds, octrees;
  for (const Json& instance : made_from) {
    made.push_back(made_by(instance));
    const Made& one = made.back();
    pictures.insert(one.frames.sequence_id + one.frames.masks_id + one.frames.dynamic_id);
    if (!one.clouds.empty()) clouds.insert(id_of(one.clouds.back()));
    if (!one.octrees.empty()) octrees.insert(id_of(one.octrees.back()));
  }
  const auto each = [](std::size_t all, std::size_t among) { return all / std::max<std::size_t>(1, among); };
  const Budget share{each(budget.points, clouds.size()), each(budget.boxes, octrees.size()),
                     each(budget.frames, pictures.size())};
  for (std::size_t i = 0; i < instances.size(); ++i) {
    instances[i]["not_shown"] = Json::array();
    add_sequence(instances[i], made[i], share.frames, page);
    add_maps(instances[i], made[i], share, instances.size() == 1, page);
  }
  facts["labels"] = shown_labels();
}

}  // namespace sediment::report
