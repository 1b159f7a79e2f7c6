#include "tools/tabulate/evaluation_table.hpp"

#include <algorithm>
#include <numeric>

#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "tools/evaluate-map/map_alignment.hpp"
#include "tools/evaluate-map/map_evaluation.hpp"
#include "tools/evaluate-trajectory/evaluation.hpp"

namespace sediment::tabulate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSequenceAxis = "sequence";

/// A figure of an instance: its heading, how it is shown, its value.
struct Measure {
  const char* heading;
  int decimals;
  double factor;
};
constexpr Measure kMeasures[] = {
    {"ATE RMSE [m]", 4, 1},       {"RPE 1 s [m]", 4, 1},       {"RPE 1 s [deg]", 3, 1},
    {"coverage [%]", 1, 100},     {"PR 5 cm [%]", 1, 100},     {"RR 5 cm [%]", 1, 100},
    {"F-score 5 cm [%]", 1, 100}, {"off surface [%]", 2, 100}, {"label mIoU [%]", 1, 100},
    {"dense [MB]", 1, 1e-6},      {"cloud [MB]", 1, 1e-6},     {"map.ot [MB]", 2, 1e-6},
    {"time [s]", 1, 1},           {"memory [MB]", 0, 1e-6},
};
constexpr std::size_t kCount = std::size(kMeasures);
enum Index {
  kAte,
  kRpe,
  kRpeAngle,
  kCoverage,
  kPreserved,
  kRejected,
  kFScore,
  kOff,
  kMiou,
  kDense,
  kCloud,
  kTree,
  kTime,
  kMemory
};

struct Judged {
  std::optional<double> values[kCount];
  std::string note;
};

/// The truth of a sequence is prepared once for all instances that map it: they are judged sequence by
/// sequence.
class Truths {
 public:
  const tools::MapTruth* of(const fs::path& sequence) {
    if (sequence != last_) {
      last_ = sequence;
      truth_.reset();
      const fs::path root = Sequence::open(sequence).groundtruth().value_or(fs::path()).parent_path();
      if (!root.empty() &&
          (fs::exists(root / "truth" / "static_cloud") || fs::exists(root / "truth" / "static_cloud.ply")))
        truth_.emplace(tools::open_true_sequence(sequence, root / "truth"), tools::MapRules{});
    }
    return truth_ ? &*truth_ : nullptr;
  }

 private:
  fs::path last_;
  std::optional<tools::MapTruth> truth_;
};

void judge_trajectory(const InstanceFacts& instance, Judged& judged) {
  const StageFacts* track = instance.last_with("trajectory");
  if (track == nullptr || instance.sequence.empty()) return;
  const auto truth_file = Sequence::open(instance.sequence).groundtruth();
  const std::size_t frames = read_tracking(track->folder).size();
  const Trajectory estimate = read_trajectory(track->folder);
  judged.values[kCoverage] =
      static_cast<double>(estimate.size()) / static_cast<double>(std::max<std::size_t>(1, frames));
  if (!truth_file) {
    judged.note = "no ground truth";
    return;
  }
  try {
    const auto evaluation =
        tools::evaluate(read_ground_truth(*truth_file), estimate, tools::FrameCount{frames, "tracking.json"});
    judged.values[kAte] = evaluation.ate.statistics.rmse;
    for (const tools::RelativeErrors& rpe : evaluation.rpe)
      if (rpe.pairs_rule == "1 s") {
        judged.values[kRpe] = rpe.translation_m.rmse;
        judged.values[kRpeAngle] = rpe.rotation_deg.rmse;
      }
  } catch (const std::exception& error) {
    judged.note = error.what();
  }
}

void judge_map(const InstanceFacts& instance, Truths& truths, Judged& judged) {
  const StageFacts *cloud = instance.last_with("cloud"), *track = instance.last_with("trajectory");
  if (cloud == nullptr || track == nullptr || instance.sequence.empty()) return;
  const tools::MapTruth* truth = truths.of(instance.sequence);
  if (truth == nullptr) return;
  const Pose truth_from_map = tools::truth_from_map(*truth->sequence(), read_trajectory(track->folder));
  const tools::MapEvaluation map = tools::evaluate_map(*truth, cloud->folder, truth_from_map);
  for (const tools::CleaningScore& score : map.cleaning)
    if (score.side_m == 0.05) {
      judged.values[kPreserved] = score.preserved();
      judged.values[kRejected] = score.rejected();
    }
  if (map.surface) judged.values[kFScore] = map.surface->f_score;
  if (map.ghosts && map.ghosts->cells > 0)
    judged.values[kOff] =
        static_cast<double>(map.ghosts->off_surface) / static_cast<double>(map.ghosts->cells);
  if (map.labels) judged.values[kMiou] = map.labels->mean_iou();
}

std::optional<double> file_bytes(const StageFacts* stage, const char* file) {
  if (stage == nullptr || !stage->files.contains(file)) return std::nullopt;
  return static_cast<double>(stage->files.at(file));
}

Judged judge(const InstanceFacts& instance, Truths& truths) {
  Judged judged;
  judge_trajectory(instance, judged);
  try {
    judge_map(instance, truths, judged);
  } catch (const std::exception& error) {
    judged.note += (judged.note.empty() ? "" : "; ") + std::string("map: ") + error.what();
  }
  const auto fuse = instance.stages.find("fuse");
  judged.values[kDense] = file_bytes(fuse == instance.stages.end() ? nullptr : &fuse->second, "cloud.pcd");
  judged.values[kCloud] = file_bytes(instance.last_with("cloud"), "cloud.pcd");
  judged.values[kTree] = file_bytes(instance.last_with("octree"), "map.ot");
  if (!instance.stages.empty()) {
    judged.values[kTime] = instance.wall_s();
    judged.values[kMemory] = static_cast<double>(instance.peak_bytes());
  } else {
    judged.note = "no result";
  }
  return judged;
}

std::string receipts_of(const InstanceFacts& instance) {
  std::string text;
  for (const char* kind : {"trajectory", "cloud", "octree"})
    if (const StageFacts* stage = instance.last_with(kind))
      text += (text.empty() ? "" : " ") + stage->short_key();
  return text;
}

/// Which measures any instance has.
std::vector<std::size_t> known(const std::vector<Judged>& all) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < kCount; ++i)
    if (std::any_of(all.begin(), all.end(), [&](const Judged& one) { return one.values[i].has_value(); }))
      indices.push_back(i);
  return indices;
}

Table table_of_each(const RunFacts& facts, const std::vector<Judged>& all,
                    const std::vector<std::size_t>& measures) {
  Table table;
  table.headings = facts.axes;
  if (facts.axes.empty()) table.headings.push_back("run");
  for (const std::size_t i : measures) table.headings.push_back(kMeasures[i].heading);
  table.headings.push_back("receipts (trajectory, cloud, octree)");
  table.headings.push_back("note");
  for (std::size_t n = 0; n < all.size(); ++n) {
    const InstanceFacts& instance = facts.instances[n];
    std::vector<Cell> row;
    for (const std::string& axis : facts.axes)
      row.push_back({instance.values.contains(axis) ? instance.values.at(axis) : "-"});
    if (facts.axes.empty()) row.push_back({facts.name});
    for (const std::size_t i : measures)
      row.push_back(shown(all[n].values[i], kMeasures[i].decimals, kMeasures[i].factor));
    row.push_back({receipts_of(instance)});
    row.push_back({all[n].note});
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// "median (least to most, n)" of a measure over a group.
Cell spread_cell(std::vector<double> values, const Measure& measure) {
  if (values.empty()) return {"-"};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = *least * measure.factor, high = *most * measure.factor,
               middle = *median(values) * measure.factor;
  if (values.size() == 1) return shown(middle, measure.decimals);
  return {formatted("%.*f (%.*f to %.*f)", measure.decimals, middle, measure.decimals, low, measure.decimals,
                    high),
          middle};
}

Table table_of_settings(const RunFacts& facts, const std::vector<Judged>& all,
                        const std::vector<std::size_t>& measures) {
  std::vector<std::string> axes;
  for (const std::string& axis : facts.axes)
    if (axis != kSequenceAxis) axes.push_back(axis);
  std::vector<std::vector<std::string>> order;
  std::map<std::vector<std::string>, std::vector<const Judged*>> groups;
  for (std::size_t n = 0; n < all.size(); ++n) {
    std::vector<std::string> setting;
    for (const std::string& axis : axes)
      setting.push_back(facts.instances[n].values.contains(axis) ? facts.instances[n].values.at(axis) : "-");
    if (!groups.contains(setting)) order.push_back(setting);
    groups[setting].push_back(&all[n]);
  }
  Table table;
  table.headings = axes;
  table.headings.push_back("sequences");
  for (const std::size_t i : measures) table.headings.push_back(kMeasures[i].heading);
  for (const auto& setting : order) {
    std::vector<Cell> row;
    for (const std::string& value : setting) row.push_back({value});
    row.push_back(shown(static_cast<double>(groups[setting].size()), 0));
    for (const std::size_t i : measures) {
      std::vector<double> values;
      for (const Judged* one : groups[setting])
        if (one->values[i]) values.push_back(*one->values[i]);
      row.push_back(spread_cell(std::move(values), kMeasures[i]));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

EvaluationTables evaluation_tables(const RunFacts& facts) {
  Truths truths;
  std::vector<Judged> all(facts.instances.size());
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return facts.instances[a].sequence < facts.instances[b].sequence;
  });
  for (const std::size_t n : order) all[n] = judge(facts.instances[n], truths);
  const auto measures = known(all);
  return {table_of_each(facts, all, measures), table_of_settings(facts, all, measures)};
}

}  // namespace sediment::tabulate
