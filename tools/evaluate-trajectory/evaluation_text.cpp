#include "tools/evaluate-trajectory/evaluation_text.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "tools/entry/formatted.hpp"

namespace sediment::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string row(const char* name, std::size_t pairs, const Statistics& s, const char* unit) {
  return formatted("  %-31s %7zu %10.6f %10.6f %10.6f %10.6f %10.6f %10.6f  %s\n", name, pairs, s.rmse,
                   s.mean, s.median, s.std, s.min, s.max, unit);
}

std::string heading(const char* name) {
  return formatted("%-33s %7s %10s %10s %10s %10s %10s %10s\n", name, "pairs", "rmse", "mean", "median",
                   "std", "min", "max");
}

std::string evo_rows(const char* name, const EvoErrors& errors) {
  const std::size_t pairs = errors.translation_m.size();
  const std::string prefix = name;
  return row((prefix + ", translation").c_str(), pairs, statistics_of(errors.translation_m), "m") +
         row((prefix + ", rotation").c_str(), pairs, statistics_of(errors.rotation_deg), "deg") +
         row((prefix + ", full").c_str(), pairs, statistics_of(errors.full), "");
}

OrderedJson json_of(const Statistics& s) {
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median},
          {"std", s.std},   {"min", s.min},   {"max", s.max}};
}

OrderedJson json_of(const Evaluation& evaluation, const char* rule) {
  for (const RelativeErrors& errors : evaluation.rpe)
    if (errors.pairs_rule == rule)
      return {{"delta", errors.pairs_rule},
              {"pairs", errors.errors.size()},
              {"translation", json_of(errors.translation_m)},
              {"rotation_deg", json_of(errors.rotation_deg)},
              {"full", json_of(errors.full)}};
  return nullptr;
}

OrderedJson json_of(const std::optional<EvoErrors>& errors) {
  if (!errors) return nullptr;
  OrderedJson json = {{"pairs", errors->translation_m.size()},
                      {"translation", json_of(statistics_of(errors->translation_m))},
                      {"rotation_deg", json_of(statistics_of(errors->rotation_deg))},
                      {"full", json_of(statistics_of(errors->full))}};
  if (errors->alignment) json["scale"] = errors->alignment->scale;
  return json;
}

}  // namespace

std::string to_text(const Evaluation& e) {
  std::string text = formatted("poses %zu, true poses %zu", e.estimate_poses, e.truth_poses);
  if (e.truth_repeated > 0) text += formatted(" (%zu stamps given twice: the last counts)", e.truth_repeated);
  text += "\n";
  if (e.frames)
    text +=
        formatted("coverage %.4f: %zu of %zu frames (", *e.coverage(), e.estimate_poses, e.frames->frames) +
        e.frames->source + ")\n";
  else
    text += "coverage unknown: --frames rgb.txt or --sequence-frames N says how many frames there were\n";
  text += "\n" + heading("TUM (0.02 s, rigid)");
  text += row("ATE", e.ate.matches.size(), e.ate.statistics, "m");
  for (const RelativeErrors& rpe : e.rpe) {
    text +=
        row(("RPE " + rpe.pairs_rule + ", translation").c_str(), rpe.errors.size(), rpe.translation_m, "m");
    text += row(("RPE " + rpe.pairs_rule + ", rotation").c_str(), rpe.errors.size(), rpe.rotation_deg, "deg");
  }
  if (e.rpe.empty() || e.rpe.front().pairs_rule != "1 s")
    text += "  RPE 1 s: none, the estimate has no two poses 1 s apart before its last\n";
  text += "\n" + heading("evo (nearest within 0.01 s)");
  text += evo_rows("APE", e.ape) + evo_rows("APE aligned", e.ape_aligned);
  if (e.ape_scaled) {
    text +=
        row("APE scaled, translation", e.evo_matches.size(), statistics_of(e.ape_scaled->translation_m), "m");
    text += formatted("  (scale %.6f)\n", e.ape_scaled->alignment->scale);
  } else {
    text += "  APE scaled: none, the estimate does not move\n";
  }
  text += evo_rows("RPE 1 frame", e.evo_rpe);
  return text;
}

nlohmann::ordered_json to_json(const Evaluation& e) {
  OrderedJson json;
  json["format"] = "sediment-trajectory-evaluation 1";
  json["poses"] = {
      {"truth", e.truth_poses}, {"truth_repeated", e.truth_repeated}, {"estimate", e.estimate_poses}};
  json["frames"] = e.frames ? OrderedJson(e.frames->frames) : OrderedJson();
  json["frames_source"] = e.frames ? OrderedJson(e.frames->source) : OrderedJson();
  json["coverage"] = e.coverage() ? OrderedJson(*e.coverage()) : OrderedJson();
  json["pairs"] = e.ate.matches.size();
  json["ate"] = json_of(e.ate.statistics);
  json["ate"]["pairs"] = e.ate.matches.size();
  json["rpe"] = json_of(e, "1 s");
  json["rpe_frame"] = json_of(e, "1 frame");
  json["rpe_random"] = json_of(e, "10000 random");
  json["evo"] = {{"pairs", e.evo_matches.size()},
                 {"ape", json_of(std::optional(e.ape))},
                 {"ape_aligned", json_of(std::optional(e.ape_aligned))},
                 {"ape_scaled", json_of(e.ape_scaled)},
                 {"rpe", json_of(std::optional(e.evo_rpe))},
                 {"rpe_scaled", json_of(e.evo_rpe_scaled)}};
  return json;
}

std::string to_csv(const Evaluation& e, const Trajectory& truth, const Trajectory& estimate) {
  std::map<std::size_t, const RelativeError*> by_pose;
  if (!e.rpe.empty() && e.rpe.front().pairs_rule == "1 s")
    for (const RelativeError& error : e.rpe.front().errors) by_pose.emplace(error.from_idx, &error);
  std::string text = "stamp,truth_stamp,ate_m,rpe_1s_m,rpe_1s_deg\n";
  for (std::size_t i = 0; i < e.ate.matches.size(); ++i) {
    const Match& match = e.ate.matches[i];
    text += estimate[match.estimate_idx].stamp + "," + truth[match.truth_idx].stamp +
            formatted(",%.9f,", e.ate.error_m[i]);
    const auto found = by_pose.find(match.estimate_idx);
    text += found == by_pose.end()
                ? ",\n"
                : formatted("%.9f,%.9f\n", found->second->translation_m, found->second->rotation_deg);
  }
  return text;
}

}  // namespace sediment::tools
