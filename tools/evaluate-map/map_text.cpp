#include <nlohmann/json.hpp>

#include "pipeline/artifacts/label_file.hpp"
#include "tools/entry/formatted.hpp"
#include "tools/evaluate-map/map_evaluation.hpp"
#include "tools/truth/share.hpp"

namespace sediment::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string line(const char* name, const std::optional<double>& value, const std::string& note = "") {
  return formatted("  %-34s", name) + (value ? formatted(" %8.4f", *value) : "        -") + "  " + note +
         "\n";
}

OrderedJson json_of(const std::optional<double>& value) {
  return value ? OrderedJson(*value) : OrderedJson();
}

std::string name_of(std::uint32_t label) {
  const Label* known = default_labels().find(label);
  return known != nullptr ? known->name : "label " + std::to_string(label);
}

std::string text_of(const SurfaceScore& s) {
  const std::string within = formatted("share within %.3g m", s.threshold_m);
  return line("accuracy, mean [m]", s.accuracy.mean_m,
              formatted("median %.4f, rmse %.4f", s.accuracy.median_m, s.accuracy.rmse_m)) +
         line("completion, mean [m]", s.completion.mean_m,
              formatted("median %.4f, rmse %.4f", s.completion.median_m, s.completion.rmse_m)) +
         line("Chamfer [m]", s.chamfer_m, "mean of both means") +
         line("precision", s.accuracy.within, within) + line("completeness", s.completion.within, within) +
         line("F-score", s.f_score);
}

std::string text_of(const CleaningScore& c) {
  const std::string at = formatted(" at %.3g m", c.side_m);
  return line(("PR" + at).c_str(), c.preserved(),
              formatted("%zu of %zu static voxels", c.still_kept, c.still)) +
         line(("RR" + at).c_str(), c.rejected(),
              formatted("%zu of %zu dynamic voxels left", c.dynamic_left, c.dynamic)) +
         line(("F1" + at).c_str(), c.f1());
}

std::string text_of(const GhostScore& g) {
  return line("off any true surface", share(g.off_surface, g.cells),
              formatted("%zu of %zu voxels", g.off_surface, g.cells)) +
         line("ghosts in free space", share(g.ghosts, g.cells),
              formatted("%zu voxels; largest cluster %zu, %zu above 20", g.ghosts, g.largest_cluster,
                        g.clusters_above_20));
}

std::string text_of(const GridScore& g) {
  return formatted("  cells %zu occupied, %zu free, %zu unknown; true %zu occupied, %zu free\n", g.occupied,
                   g.free, g.unknown, g.true_occupied, g.true_free) +
         line("free space, precision", g.free_precision, "an obstacle may be one cell off") +
         line("free space, precision, strict", g.free_precision_strict) +
         line("free space, recall", g.free_recall, "where the ground was seen") +
         line("free, but never observed", g.free_unobserved) +
         line("occupied, precision", g.occupied_precision) + line("occupied, recall", g.occupied_recall) +
         line("tilt of the ground [deg]", g.tilt_deg) + line("height of the ground [m]", g.ground_offset_m);
}

OrderedJson json_of(const Distances& d) {
  return {{"mean", d.mean_m}, {"median", d.median_m}, {"rmse", d.rmse_m}, {"within", d.within}};
}

}  // namespace

std::string to_text(const MapEvaluation& e) {
  std::string text = e.path + "  (" + e.kind + ", " + e.alignment + ")\n";
  if (e.points > 0) text += formatted("  %zu points", e.points);
  if (e.not_finite > 0) text += formatted(", %zu not finite left out", e.not_finite);
  if (e.points > 0) text += "\n";
  if (e.surface) text += text_of(*e.surface);
  for (const CleaningScore& score : e.cleaning) text += text_of(score);
  if (e.by_points)
    text += line("SA", e.by_points->static_accuracy, "true static points kept") +
            line("DA", e.by_points->dynamic_accuracy, "true dynamic points removed") +
            line("AA", e.by_points->associated()) + line("HA", e.by_points->harmonic());
  if (e.ghosts) text += text_of(*e.ghosts);
  if (e.octree)
    text += line("occupied cells, precision", e.octree->occupied_precision) +
            line("occupied cells, recall", e.octree->occupied_recall) +
            line("free space, precision", e.octree->free_precision) +
            line("free space, recall", e.octree->free_recall);
  if (e.grid) text += text_of(*e.grid);
  if (e.labels && e.labels->mean_iou()) {
    text += line("label mIoU", e.labels->mean_iou());
    for (const auto& [label, pixels] : e.labels->classes)
      text += line(("  " + name_of(label)).c_str(), pixels.iou(),
                   formatted("%zu true points", pixels.both + pixels.only_truth));
  }
  return text;
}

nlohmann::ordered_json to_json(const MapEvaluation& e) {
  OrderedJson json = {{"map", e.path}, {"kind", e.kind}, {"alignment", e.alignment}};
  if (e.points > 0) json["points"] = e.points;
  if (e.points > 0) json["points_not_finite"] = e.not_finite;
  if (const auto& s = e.surface) {
    json["accuracy_m"] = json_of(s->accuracy);
    json["completion_m"] = json_of(s->completion);
    json["chamfer_m"] = s->chamfer_m;
    json["precision"] = s->accuracy.within;
    json["completeness"] = s->completion.within;
    json["f_score"] = s->f_score;
  }
  for (const CleaningScore& c : e.cleaning)
    json["cleaning"].push_back({{"voxel_m", c.side_m},
                                {"pr", json_of(c.preserved())},
                                {"rr", json_of(c.rejected())},
                                {"f1", json_of(c.f1())},
                                {"static_voxels", c.still},
                                {"dynamic_voxels", c.dynamic},
                                {"dynamic_voxels_left", c.dynamic_left}});
  if (const auto& p = e.by_points)
    json["points_score"] = {{"sa", json_of(p->static_accuracy)},
                            {"da", json_of(p->dynamic_accuracy)},
                            {"aa", json_of(p->associated())},
                            {"ha", json_of(p->harmonic())}};
  if (const auto& g = e.ghosts)
    json["ghosts"] = {{"voxels", g->cells},
                      {"off_surface", g->off_surface},
                      {"off_surface_share", json_of(share(g->off_surface, g->cells))},
                      {"in_free_space", g->ghosts},
                      {"in_free_space_share", json_of(share(g->ghosts, g->cells))},
                      {"largest_cluster", g->largest_cluster},
                      {"clusters_above_20", g->clusters_above_20}};
  if (const auto& o = e.octree)
    json["octree"] = {{"resolution_m", o->resolution_m},
                      {"occupied_precision", json_of(o->occupied_precision)},
                      {"occupied_recall", json_of(o->occupied_recall)},
                      {"free_precision", json_of(o->free_precision)},
                      {"free_recall", json_of(o->free_recall)}};
  if (const auto& g = e.grid)
    json["grid"] = {{"occupied", g->occupied},
                    {"free", g->free},
                    {"unknown", g->unknown},
                    {"free_precision", json_of(g->free_precision)},
                    {"free_precision_strict", json_of(g->free_precision_strict)},
                    {"free_recall", json_of(g->free_recall)},
                    {"free_unobserved", json_of(g->free_unobserved)},
                    {"occupied_precision", json_of(g->occupied_precision)},
                    {"occupied_recall", json_of(g->occupied_recall)},
                    {"tilt_deg", g->tilt_deg},
                    {"ground_offset_m", g->ground_offset_m}};
  if (e.labels) {
    json["label_miou"] = json_of(e.labels->mean_iou());
    json["label_iou"] = OrderedJson::object();
    for (const auto& [label, pixels] : e.labels->classes) json["label_iou"][name_of(label)] = pixels.iou();
  }
  return json;
}

}  // namespace sediment::tools
