#include "tools/evaluate-trajectory/evo_archive.hpp"

#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tools/evaluate-trajectory/zip_file.hpp"

namespace sediment::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// numpy's .npy format 1.0: a header of 64 bytes times n, then the values.
std::string npy_of(const std::vector<double>& values) {
  std::string header =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(values.size()) + ",), }";
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 10 - 1, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes.push_back(static_cast<char>(header.size() & 0xff));
  bytes.push_back(static_cast<char>(header.size() >> 8));
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  return bytes;
}

std::string tum_line(double stamp_s, const Pose& pose) {
  const Vec3 t = pose.translation;
  const Quaternion q = quaternion_of(pose);
  char text[256];
  std::snprintf(text, sizeof text, "%.9f %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", stamp_s, t.x, t.y, t.z,
                q.x, q.y, q.z, q.w);
  return text;
}

OrderedJson stats_of(const std::vector<double>& errors) {
  const Statistics s = statistics_of(errors);
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"std", s.std},
          {"min", s.min},   {"max", s.max},   {"sse", s.sse}};
}

/// `first_match` is the match that the first error belongs to.
void write_archive(const std::filesystem::path& zip, OrderedJson info, const std::vector<double>& errors,
                   std::size_t first_match, const std::vector<Match>& matches, const Trajectory& truth,
                   const Trajectory& estimate, const std::optional<Alignment>& alignment) {
  const std::string truth_name = info["ref_name"], estimate_name = info["est_name"];
  std::string truth_text, estimate_text;
  for (const Match& match : matches) {
    const StampedPose &of_truth = truth[match.truth_idx], &of_estimate = estimate[match.estimate_idx];
    truth_text += tum_line(of_truth.stamp_s, of_truth.world_from_camera);
    estimate_text += tum_line(of_estimate.stamp_s, alignment ? *alignment * of_estimate.world_from_camera
                                                             : of_estimate.world_from_camera);
  }
  std::vector<double> stamps_s, from_start_s;
  for (std::size_t i = first_match; i < matches.size(); ++i) {
    stamps_s.push_back(estimate[matches[i].estimate_idx].stamp_s);
    from_start_s.push_back(stamps_s.back() - estimate[matches[0].estimate_idx].stamp_s);
  }
  write_bytes(zip, {zip_of({{"info.json", info.dump()},
                            {"stats.json", stats_of(errors).dump()},
                            {"error_array.npy", npy_of(errors)},
                            {"seconds_from_start.npy", npy_of(from_start_s)},
                            {"timestamps.npy", npy_of(stamps_s)},
                            {truth_name + ".tum", truth_text},
                            {estimate_name + ".tum", estimate_text}})});
}

}  // namespace

void write_evo_ape(const std::filesystem::path& zip, const Evaluation& e, const Trajectory& truth,
                   const Trajectory& estimate, const std::string& truth_name,
                   const std::string& estimate_name) {
  write_archive(zip,
                {{"title", "APE w.r.t. translation part (m)\n(with SE(3) Umeyama alignment)"},
                 {"ref_name", truth_name},
                 {"est_name", estimate_name},
                 {"label", "APE (m)"}},
                e.ape_aligned.translation_m, 0, e.evo_matches, truth, estimate, e.ape_aligned.alignment);
}

void write_evo_rpe(const std::filesystem::path& zip, const Evaluation& e, const Trajectory& truth,
                   const Trajectory& estimate, const std::string& truth_name,
                   const std::string& estimate_name) {
  write_archive(zip,
                {{"title", "RPE w.r.t. translation part (m)\nfor delta = 1 (frames) using consecutive pairs"},
                 {"ref_name", truth_name},
                 {"est_name", estimate_name},
                 {"label", "RPE (m)"}},
                e.evo_rpe.translation_m, 1, e.evo_matches, truth, estimate, std::nullopt);
}

}  // namespace sediment::tools
