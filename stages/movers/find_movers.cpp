#include "stages/movers/find_movers.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "stages/movers/other_view.hpp"
#include "stages/movers/sequence_views.hpp"

namespace sediment::movers {
namespace {

constexpr std::size_t kBatch = 16;
constexpr std::size_t kWitnesses = 2;     ///< frames on either side
constexpr double kWitnessPause_s = 0.25;  ///< frames further apart bear no witness
constexpr double kStampError_s = 5e-4;    ///< stamps are rounded
constexpr int kOutline_px = 5;            ///< pixels near the outlines that the grid leaves open
constexpr double kFastest_px_s =
    900;  ///< across the image, that a mover may have besides the camera's motion

/// A frame in memory.
struct Look {
  bool has_pose = false;
  View view;
  cv::Mat regions;    ///< candidates, on the grid
  cv::Mat confirmed;  ///< those that have witnesses
  cv::Mat lasting;    ///< as of the verdicts
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
        views_(sequence, dynamic, trajectory) {
    choose_references();
  }

  Counts run() {
    for (std::size_t begin = 0; begin < sequence_.size(); begin += kBatch) {
      const std::size_t end = std::min(begin + kBatch, sequence_.size());
      load_references(begin, end);
      look(begin, end);
      confirm_until(end == sequence_.size() ? end : end - std::min(end, kWitnesses));
      finish_until(end == sequence_.size() ? end : confirmed_ - std::min(confirmed_, parameters_.margin));
    }
    writer_.finish();
    return counts_;
  }

 private:
  /// Frames with a pose, evenly in time: one set for all, so that each is read once.
  void choose_references() {
    const double apart_s = 2 * parameters_.reach_s / parameters_.views;
    double next_s = -1e300;
    for (std::size_t i = 0; i < sequence_.size(); ++i) {
      if (!views_.has_pose(i)) {
        ++counts_.frames_without_pose;
        continue;
      }
      if (views_.stamp_s(i) < next_s - kStampError_s) continue;
      references_[i] = {};
      next_s = views_.stamp_s(i) + apart_s;
    }
    counts_.references = references_.size();
    if (references_.empty())
      throw std::runtime_error("no frame of the sequence has a pose in the trajectory: nothing contradicts");
  }

  /// How far in time a frame looks: near the sequence's ends about as far to either side, or what rests there
  /// and moves later would be contradicted more often than seen.
  double reach_of(std::size_t i) const {
    const double to_end_s = std::min(views_.apart_s(0, i), views_.apart_s(i, sequence_.size() - 1));
    return std::clamp(to_end_s, 2 * parameters_.reach_s / 3, parameters_.reach_s);
  }

  /// Those that the frames begin .. end - 1 need; others are forgotten.
  void load_references(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> missing;
    for (auto& [i, reference] : references_) {
      const double before_s = views_.stamp_s(begin) - views_.stamp_s(i),
                   after_s = views_.stamp_s(i) - views_.stamp_s(end - 1);
      const bool needed = std::max(before_s, after_s) <= parameters_.reach_s + 2 * kStampError_s;
      if (!needed)
        reference = {};
      else if (reference.depth.empty())
        missing.push_back(i);
    }
    tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t m) {
      references_.at(missing[m]) =
          reference_of(views_.read(missing[m]), sequence_.camera(), parameters_.contradiction);
    });
  }

  void look(std::size_t begin, std::size_t end) {
    const std::size_t first = looks_.size();
    looks_.resize(first + end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t i) {
      Look& look = looks_[first + i - begin];
      look.view = views_.read(i);
      look.has_pose = views_.has_pose(i);
      look.regions =
          cv::Mat(look.view.depth.rows / kStep_px, look.view.depth.cols / kStep_px, CV_8UC1, cv::Scalar(0));
      if (!look.has_pose) return;
      std::vector<const Reference*> others;
      const double reach_s = reach_of(i);
      for (const auto& [r, reference] : references_)
        if (r != i && views_.apart_s(r, i) <= reach_s + kStampError_s) others.push_back(&reference);
      const Verdicts verdicts =
          verdicts_of(look.view, others, sequence_.camera(), rays_, parameters_.contradiction);
      look.lasting = verdicts.lasting;
      look.regions = regions_of(verdicts, look.view, sequence_.camera().depth_scale, parameters_.regions);
    });
  }

  /// Calls visit(look, frame) for the frames in memory up to `reach` before and after one, without itself.
  template <class Visit>
  void for_each_near(std::size_t i, std::size_t reach, Visit visit) const {
    const std::size_t first = std::max(begin_, i - std::min(i, reach)),
                      end = std::min(begin_ + looks_.size(), i + reach + 1);
    for (std::size_t k = first; k < end; ++k)
      if (k != i && looks_[k - begin_].has_pose && views_.apart_s(i, k) <= kWitnessPause_s)
        visit(looks_[k - begin_], k);
  }

  cv::Mat confirmed(std::size_t i) const {
    const Look& here = looks_[i - begin_];
    if (parameters_.min_witnesses == 0 || cv::countNonZero(here.regions) == 0) return here.regions;
    cv::Mat votes(here.regions.size(), CV_8UC1, cv::Scalar(0));
    for_each_near(i, kWitnesses, [&](const Look& there, std::size_t k) {
      votes += confirmed_by(here.regions, here.view, there.regions, there.view, sequence_.camera(), rays_,
                            static_cast<int>(kFastest_px_s * views_.apart_s(i, k))) &
               1;
    });
    return votes >= parameters_.min_witnesses;
  }

  void confirm_until(std::size_t end) {
    tbb::parallel_for(confirmed_, std::max(confirmed_, end),
                      [&](std::size_t i) { looks_[i - begin_].confirmed = confirmed(i); });
    confirmed_ = std::max(confirmed_, end);
  }

  /// With what the frames around show in the same place, but for what is always there.
  cv::Mat with_margin(std::size_t i) const {
    const Look& here = looks_[i - begin_];
    if (!here.has_pose) return here.confirmed;
    cv::Mat carried(here.regions.size(), CV_8UC1, cv::Scalar(0));
    for_each_near(i, parameters_.margin, [&](const Look& there, std::size_t) {
      carried |= carried_from(there.confirmed, there.view, here.view, sequence_.camera(), rays_);
    });
    return here.confirmed | without_speckle(carried & (here.lasting == 0));
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
      cv::Mat full = outlined(with_margin(i), view.depth, sequence_.camera().depth_scale, kOutline_px);
      full &= mask == kStatic;
      mask.setTo(kNonPriorDynamic, full);
      added[i - begin] = static_cast<std::uint64_t>(cv::countNonZero(full));
      writer_.write(views_.stamp(i), mask, interactions_of(views_.stamp(i)));
      on_frame_();
    });
    for (const std::uint64_t pixels : added) {
      counts_.pixels_added += pixels;
      counts_.frames_with_movers += pixels > 0;
    }
    finished_ = std::max(begin, end);
    while (begin_ + std::max(kWitnesses, parameters_.margin) < finished_) {
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
  SequenceViews views_;
  std::map<std::size_t, Reference> references_;  ///< by frame; empty while not needed
  std::deque<Look> looks_;                       ///< frames begin_ and on
  std::size_t begin_ = 0, confirmed_ = 0, finished_ = 0;
  Counts counts_;
};

}  // namespace

Counts find_movers(const Sequence& sequence, const DynamicMasksReader& dynamic, const Trajectory& trajectory,
                   const Parameters& parameters, DynamicMasksWriter& writer,
                   const std::function<void()>& on_frame) {
  return Search(sequence, dynamic, trajectory, parameters, writer, on_frame).run();
}

}  // namespace sediment::movers
