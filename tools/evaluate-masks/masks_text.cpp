#include "tools/evaluate-masks/masks_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/text_table.hpp"
#include "tools/chart/chart.hpp"
#include "tools/entry/formatted.hpp"

namespace sediment::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string number(const std::optional<double>& value) {
  return value ? formatted("%9.4f", *value) : "        -";
}

OrderedJson json_of(const std::optional<double>& value) {
  return value ? OrderedJson(*value) : OrderedJson();
}

/// Mean over the frames that have the figure.
template <class Figure>
std::optional<double> mean_of(const DynamicEvaluation& evaluation, const Figure& figure) {
  double sum = 0;
  std::size_t count = 0;
  for (const FrameMasks& frame : evaluation.frames)
    if (const std::optional<double> value = figure(frame)) {
      sum += *value;
      ++count;
    }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::optional<double> mean_boundary_f(const DynamicEvaluation& evaluation) {
  return mean_of(evaluation, [](const FrameMasks& frame) { return frame.boundary_f; });
}

/// Recall of the true pixels of value 1 or 2.
std::optional<double> recall_of(const DynamicEvaluation& evaluation, std::uint64_t FrameMasks::*pixels,
                                std::uint64_t FrameMasks::*hit) {
  std::uint64_t all = 0, found = 0;
  for (const FrameMasks& frame : evaluation.frames) {
    all += frame.*pixels;
    found += frame.*hit;
  }
  return share(found, all);
}

std::string misses(const DynamicEvaluation& e) {
  std::string text = formatted("missed frames %zu of %zu with a mover above 1 %% of the image\n",
                               e.missed_frames(), e.frames_with_mover());
  std::size_t listed = 0;
  for (const FrameMasks& frame : e.frames)
    for (const MissedMover& mover : frame.missed) {
      if (++listed > 20) return text + "  ... (--json lists all)\n";
      text += "  " + frame.stamp + "  " + mover.name +
              formatted("  %.1f %% of the image, recall %.2f\n", 100 * mover.share, mover.recall);
    }
  return text;
}

Series line(const char* name, std::array<std::uint8_t, 3> rgb, const DynamicEvaluation& evaluation,
            const std::function<std::optional<double>(const FrameMasks&)>& figure) {
  Series series{name, {}, rgb};
  const double start_s = parse_number(evaluation.frames.front().stamp).value_or(0);
  for (const FrameMasks& frame : evaluation.frames)
    series.points.emplace_back(parse_number(frame.stamp).value_or(0) - start_s, figure(frame).value_or(NAN));
  return series;
}

}  // namespace

std::string to_text(const DynamicEvaluation& e) {
  const Overlap total = e.total();
  std::string text =
      formatted("frames %zu (truth %zu, masks %zu)\n\n", e.frames.size(), e.truth_frames, e.mask_frames);
  text += "                     all pixels  mean of frames\n";
  const auto row = [&](const char* name, const std::optional<double>& all,
                       const std::optional<double>& mean) {
    text += formatted("%-20s", name) + "  " + number(all) + "       " + number(mean) + "\n";
  };
  row("IoU", total.iou(), mean_of(e, [](const FrameMasks& f) { return f.overlap.iou(); }));
  row("precision", total.precision(), mean_of(e, [](const FrameMasks& f) { return f.overlap.precision(); }));
  row("recall", total.recall(), mean_of(e, [](const FrameMasks& f) { return f.overlap.recall(); }));
  row("  prior dynamic", recall_of(e, &FrameMasks::prior, &FrameMasks::prior_hit), std::nullopt);
  row("  non-prior dynamic", recall_of(e, &FrameMasks::non_prior, &FrameMasks::non_prior_hit), std::nullopt);
  row("boundary F", std::nullopt, mean_boundary_f(e));
  row("static pixels lost", share(total.extra, total.extra + total.none), std::nullopt);
  text += "\n" + misses(e);
  if (!e.by_instance) return text;
  text += "\nclass                  dynamic px    recall   static px   lost\n";
  for (const auto& [name, pixels] : e.classes()) {
    text += formatted("%-20s %12llu ", name.c_str(), static_cast<unsigned long long>(pixels.dynamic)) +
            number(share(pixels.dynamic_masked, pixels.dynamic)) +
            formatted(" %11llu", static_cast<unsigned long long>(pixels.still)) +
            number(share(pixels.still_masked, pixels.still)) + "\n";
  }
  return text;
}

std::string to_text(const InstanceEvaluation& e) {
  std::string text = formatted("frames %zu (truth %zu)\n\n", e.frames, e.truth_frames);
  text += "class                  truth   found matched    recall precision  mean IoU switches\n";
  for (const auto& [name, of] : e.classes) {
    if (of.truth == 0 && of.found == 0) continue;
    text +=
        formatted("%-20s %7zu %7zu %7zu ", name.c_str(), of.truth, of.found, of.matched) +
        number(share(of.matched, of.truth)) + number(share(of.matched, of.found)) +
        number(of.matched == 0 ? std::nullopt : std::optional(of.iou_sum / static_cast<double>(of.matched))) +
        formatted(" %8zu\n", of.switches);
  }
  return text;
}

nlohmann::ordered_json to_json(const DynamicEvaluation& e) {
  const Overlap total = e.total();
  OrderedJson json;
  json["format"] = "sediment-mask-evaluation 1";
  json["frames"] = e.frames.size();
  json["truth_frames"] = e.truth_frames;
  json["mask_frames"] = e.mask_frames;
  json["iou"] = json_of(total.iou());
  json["precision"] = json_of(total.precision());
  json["recall"] = json_of(total.recall());
  json["recall_prior"] = json_of(recall_of(e, &FrameMasks::prior, &FrameMasks::prior_hit));
  json["recall_non_prior"] = json_of(recall_of(e, &FrameMasks::non_prior, &FrameMasks::non_prior_hit));
  json["boundary_f"] = json_of(mean_boundary_f(e));
  json["static_lost"] = json_of(share(total.extra, total.extra + total.none));
  json["frames_with_mover"] = e.frames_with_mover();
  json["missed_frames"] = e.missed_frames();
  json["by_instance"] = e.by_instance;
  json["classes"] = OrderedJson::object();
  for (const auto& [name, pixels] : e.classes())
    json["classes"][name] = {{"dynamic_pixels", pixels.dynamic},
                             {"recall", json_of(share(pixels.dynamic_masked, pixels.dynamic))},
                             {"static_pixels", pixels.still},
                             {"static_lost", json_of(share(pixels.still_masked, pixels.still))}};
  json["over_time"] = OrderedJson::array();
  for (const FrameMasks& frame : e.frames) {
    OrderedJson missed = OrderedJson::array();
    for (const MissedMover& mover : frame.missed)
      missed.push_back({{"mover", mover.name}, {"share", mover.share}, {"recall", mover.recall}});
    json["over_time"].push_back({{"stamp", frame.stamp},
                                 {"iou", json_of(frame.overlap.iou())},
                                 {"precision", json_of(frame.overlap.precision())},
                                 {"recall", json_of(frame.overlap.recall())},
                                 {"boundary_f", json_of(frame.boundary_f)},
                                 {"missed", missed}});
  }
  return json;
}

nlohmann::ordered_json to_json(const InstanceEvaluation& e) {
  OrderedJson json = {{"format", "sediment-instance-evaluation 1"},
                      {"frames", e.frames},
                      {"truth_frames", e.truth_frames},
                      {"classes", OrderedJson::object()}};
  for (const auto& [name, of] : e.classes)
    json["classes"][name] = {
        {"truth", of.truth},
        {"found", of.found},
        {"matched", of.matched},
        {"recall", json_of(share(of.matched, of.truth))},
        {"precision", json_of(share(of.matched, of.found))},
        {"mean_iou",
         of.matched == 0 ? OrderedJson() : OrderedJson(of.iou_sum / static_cast<double>(of.matched))},
        {"identity_switches", of.switches}};
  return json;
}

cv::Mat plot(const DynamicEvaluation& e) {
  Panel figures{"dynamic masks against the truth", "time [s]", "", {}};
  figures.from_zero = true;
  figures.series = {
      line("IoU", {150, 150, 150}, e, [](const FrameMasks& f) { return f.overlap.iou(); }),
      line("precision", {25, 90, 200}, e, [](const FrameMasks& f) { return f.overlap.precision(); }),
      line("recall", {215, 60, 45}, e, [](const FrameMasks& f) { return f.overlap.recall(); })};
  Panel moving{"what moves", "time [s]", "share of the image", {}};
  moving.from_zero = true;
  moving.series = {
      line("truth", {60, 60, 60}, e,
           [](const FrameMasks& f) { return share(f.overlap.hit + f.overlap.missed, f.overlap.pixels()); }),
      line("masks", {25, 90, 200}, e,
           [](const FrameMasks& f) { return share(f.overlap.hit + f.overlap.extra, f.overlap.pixels()); })};
  return draw({figures, moving});
}

}  // namespace sediment::tools
