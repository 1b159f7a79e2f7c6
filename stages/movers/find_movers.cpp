#include "stages/movers/find_movers.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "pipeline/scene/frame_poses.hpp"

namespace sediment::movers {
namespace {

constexpr std::size_t kBatch = 16;
constexpr std::size_t kWitnesses = 2;     ///< frames on either side
constexpr double kWitnessPause_s = 0.25;  ///< frames further apart bear no witness
constexpr int kOutline_px = 5;            ///< pixels near the outlines that the grid leaves open
constexpr double kFastest_px_s =
    900;  ///< across the image, that a mover may have besides the camera's motion

/// A frame in memory.
struct Look {
  bool has_pose = false;
  View view;
  cv::Mat regions;  ///< candidates, on the grid
};

class Search {
 public:
  Search(const Sequence& sequence, const DynamicMasksReader& dynamic, const Trajectory& trajectory,
         const Parameters& parameters, DynamicMasksWriter& writer, const std::function<void()>& on_frame)
      : sequence_(sequence),
        dynamic_(dynamic),
        interactions_(dynamic.interactions()),
        parameters_(parameters),
        writer_(writer),
        on_frame_(on_frame),
        rays_(rays_of(sequence.camera())),
        stamps_(stamps_of(sequence)),
        poses_(stamps_, trajectory) {
    choose_references();
  }

  Counts run() {
    for (std::size_t begin = 0; begin < sequence_.size(); begin += kBatch) {
      const std::size_t end = std::min(begin + kBatch, sequence_.size());
      load_references(begin, end);
      look(begin, end);
      finish_until(end == sequence_.size() ? end : end - std::min(end, kWitnesses));
    }
    writer_.finish();
    return counts_;
  }

 private:
  static std::vector<FrameStamp> stamps_of(const Sequence& sequence) {
    std::vector<FrameStamp> stamps;
    for (std::size_t i = 0; i < sequence.size(); ++i)
      stamps.push_back({sequence.entry(i).stamp, sequence.entry(i).stamp_s});
    return stamps;
  }

  /// Frames with a pose, evenly in time: one set for all, so that each is read once.
  void choose_references() {
    const double apart_s = 2 * parameters_.reach_s / parameters_.views;
    double next_s = -1e300;
    for (std::size_t i = 0; i < stamps_.size(); ++i) {
      if (!poses_.pose_of(stamps_[i])) {
        ++counts_.frames_without_pose;
        continue;
      }
      // Half a millisecond: stamps are rounded.
      if (stamps_[i].stamp_s < next_s - 5e-4) continue;
      references_[i] = {};
      next_s = stamps_[i].stamp_s + apart_s;
    }
    counts_.references = references_.size();
    if (references_.empty())
      throw std::runtime_error("no frame of the sequence has a pose in the trajectory: nothing contradicts");
  }

  /// From the poses of the frames before and after.
  Speed speed_of(std::size_t i) const {
    const std::size_t before = i - std::min<std::size_t>(i, 1), after = std::min(i + 1, stamps_.size() - 1);
    const auto from = poses_.pose_of(stamps_[before]), to = poses_.pose_of(stamps_[after]);
    const double seconds = stamps_[after].stamp_s - stamps_[before].stamp_s;
    if (!from || !to || !(seconds > 0)) return {};
    const Pose moved = from->inverse() * *to;
    return {norm(moved.translation) / seconds, rotation_angle(moved) / seconds};
  }

  View read_view(std::size_t i) const {
    View view{
        stamps_[i].stamp_s, poses_.pose_of(stamps_[i]).value_or(Pose{}), speed_of(i), sequence_.depth(i), {}};
    const std::string& stamp = stamps_[i].stamp;
    view.dynamic =
        dynamic_.has(stamp) ? dynamic_.read(stamp) : cv::Mat(view.depth.size(), CV_8UC1, cv::Scalar(kStatic));
    if (view.dynamic.size() != view.depth.size())
      throw std::runtime_error("dynamic mask of frame " + stamp + ": " + std::to_string(view.dynamic.cols) +
                               " x " + std::to_string(view.dynamic.rows) + " pixels, the depth image has " +
                               std::to_string(view.depth.cols) + " x " + std::to_string(view.depth.rows));
    return view;
  }

  bool near_in_time(std::size_t a, std::size_t b, double reach_s) const {
    return std::abs(stamps_[a].stamp_s - stamps_[b].stamp_s) <= reach_s + 5e-4;
  }

  /// Those that the frames begin .. end - 1 need; others are forgotten.
  void load_references(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> missing;
    for (auto& [i, reference] : references_) {
      const bool needed = stamps_[i].stamp_s >= stamps_[begin].stamp_s - parameters_.reach_s - 1e-3 &&
                          stamps_[i].stamp_s <= stamps_[end - 1].stamp_s + parameters_.reach_s + 1e-3;
      if (!needed)
        reference = {};
      else if (reference.depth.empty())
        missing.push_back(i);
    }
    tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t m) {
      references_.at(missing[m]) =
          reference_of(read_view(missing[m]), sequence_.camera(), parameters_.contradiction);
    });
  }

  void look(std::size_t begin, std::size_t end) {
    const std::size_t first = looks_.size();
    looks_.resize(first + end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t i) {
      Look& look = looks_[first + i - begin];
      look.view = read_view(i);
      look.has_pose = poses_.pose_of(stamps_[i]).has_value();
      look.regions =
          cv::Mat(look.view.depth.rows / kStep_px, look.view.depth.cols / kStep_px, CV_8UC1, cv::Scalar(0));
      if (!look.has_pose) return;
      std::vector<const Reference*> others;
      for (const auto& [r, reference] : references_)
        if (r != i && near_in_time(r, i, parameters_.reach_s)) others.push_back(&reference);
      const Verdicts verdicts =
          verdicts_of(look.view, others, sequence_.camera(), rays_, parameters_.contradiction);
      look.regions = regions_of(verdicts, look.view, sequence_.camera().depth_scale, parameters_.regions);
    });
  }

  cv::Mat confirmed(std::size_t i) const {
    const Look& here = looks_[i - begin_];
    if (parameters_.min_witnesses == 0 || cv::countNonZero(here.regions) == 0) return here.regions;
    cv::Mat votes(here.regions.size(), CV_8UC1, cv::Scalar(0));
    for (std::size_t k = i - std::min(i, kWitnesses); k <= i + kWitnesses && k - begin_ < looks_.size();
         ++k) {
      if (k == i || k < begin_) continue;
      const Look& there = looks_[k - begin_];
      if (!there.has_pose || !near_in_time(i, k, kWitnessPause_s)) continue;
      const double apart_s = std::abs(stamps_[i].stamp_s - stamps_[k].stamp_s);
      votes += confirmed_by(here.regions, here.view, there.regions, there.view, sequence_.camera(), rays_,
                            static_cast<int>(kFastest_px_s * apart_s)) &
               1;
    }
    return votes >= parameters_.min_witnesses;
  }

  /// What was decided before, for those who look at these masks.
  std::vector<Interaction> interactions_of(const std::string& stamp) const {
    const auto found = interactions_.find(stamp);
    return found == interactions_.end() ? std::vector<Interaction>{} : found->second;
  }

  void finish_until(std::size_t end) {
    const std::size_t begin = finished_;
    std::vector<std::uint64_t> added(std::max(end, begin) - begin);
    tbb::parallel_for(begin, std::max(begin, end), [&](std::size_t i) {
      const View& view = looks_[i - begin_].view;
      cv::Mat mask = view.dynamic.clone();
      cv::Mat full = outlined(confirmed(i), view.depth, sequence_.camera().depth_scale, kOutline_px);
      full &= mask == kStatic;
      mask.setTo(kNonPriorDynamic, full);
      added[i - begin] = static_cast<std::uint64_t>(cv::countNonZero(full));
      writer_.write(stamps_[i].stamp, mask, interactions_of(stamps_[i].stamp));
      on_frame_();
    });
    for (const std::uint64_t pixels : added) {
      counts_.pixels_added += pixels;
      counts_.frames_with_movers += pixels > 0;
    }
    finished_ = std::max(begin, end);
    while (begin_ + kWitnesses < finished_) {
      looks_.pop_front();
      ++begin_;
    }
  }

  const Sequence& sequence_;
  const DynamicMasksReader& dynamic_;
  const std::map<std::string, std::vector<Interaction>> interactions_;
  const Parameters& parameters_;
  DynamicMasksWriter& writer_;
  const std::function<void()>& on_frame_;
  std::vector<Ray> rays_;
  std::vector<FrameStamp> stamps_;
  FramePoses poses_;
  std::map<std::size_t, Reference> references_;  ///< by frame; empty while not needed
  std::deque<Look> looks_;                       ///< frames begin_ and on
  std::size_t begin_ = 0, finished_ = 0;
  Counts counts_;
};

}  // namespace

Counts find_movers(const Sequence& sequence, const DynamicMasksReader& dynamic, const Trajectory& trajectory,
                   const Parameters& parameters, DynamicMasksWriter& writer,
                   const std::function<void()>& on_frame) {
  return Search(sequence, dynamic, trajectory, parameters, writer, on_frame).run();
}

}  // namespace sediment::movers
