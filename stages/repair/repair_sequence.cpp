#include "stages/repair/repair_sequence.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "stages/repair/link.hpp"
#include "stages/repair/speed.hpp"

namespace sediment::repair {
namespace {

/// Frames read at a time: a fixed number, as what is known of an object's class grows with each batch.
constexpr std::size_t kBatch = 16;
constexpr std::size_t kMostTracks = 65534;  ///< an id has 16 bits

/// What is kept of a frame when its images are gone.
struct FrameResult {
  std::map<int, Displacement> moved;  ///< by id
  std::size_t repaired = 0;
};

class Repair {
 public:
  Repair(const Sequence& sequence, const MasksReader& masks, const LabelTable& labels,
         const Parameters& parameters, MasksWriter& writer, const std::function<void()>& on_frame)
      : sequence_(sequence),
        masks_(masks),
        labels_(labels),
        parameters_(parameters),
        writer_(writer),
        on_frame_(on_frame),
        rays_(rays_of(sequence.camera())),
        depth_scale_(sequence.camera().depth_scale),
        reach_(static_cast<std::size_t>(std::max({parameters.vote.max_gap, parameters.vote.neighbors, 1}))),
        results_(sequence.size()) {}

  Counts run() {
    for (std::size_t begin = 0; begin < sequence_.size(); begin += kBatch) {
      const std::size_t end = std::min(begin + kBatch, sequence_.size());
      read(begin, end);
      for (std::size_t i = begin; i < end; ++i)
        link(clip_, i, depth_scale_, {.max_gap = parameters_.vote.max_gap}, tracks_);
      if (tracks_.size() > kMostTracks)
        throw std::runtime_error("more than 65534 objects: the detections do not hold together");
      confirm_until(end == sequence_.size() ? end : end - std::min(end, reach_));
      finish_until(end == sequence_.size() ? end : confirmed_ - std::min(confirmed_, reach_));
      clip_.drop_before(finished_ - std::min(finished_, reach_ + 1));
    }
    finish_writer();
    return counts_;
  }

 private:
  void read(std::size_t begin, std::size_t end) {
    std::vector<ClipFrame> frames(end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t i) { frames[i - begin] = read_frame(i); });
    for (ClipFrame& frame : frames) clip_.push_back(std::move(frame));
    tbb::parallel_for(std::max<std::size_t>(begin, 1), end, [&](std::size_t i) {
      ClipFrame &before = clip_.at(i - 1), &after = clip_.at(i);
      if (after.stamp_s - before.stamp_s > parameters_.longest_pause_s) return;
      before.to_next = flow_between(before.flow_image, after.flow_image, before.color.size());
      after.to_previous = flow_between(after.flow_image, before.flow_image, before.color.size());
    });
  }

  ClipFrame read_frame(std::size_t frame_idx) const {
    Frame frame = sequence_.frame(frame_idx);
    ClipFrame read{frame_idx,
                   frame.stamp,
                   frame.stamp_s,
                   frame.color,
                   frame.depth,
                   flow_image(frame.color),
                   masks_.read(frame.stamp),
                   {},
                   {},
                   {},
                   {}};
    const cv::Size mask = read.detections.ids.size(), image = read.color.size();
    if (mask != image)
      throw std::runtime_error("frame " + frame.stamp + ": the mask is " + std::to_string(mask.width) + "x" +
                               std::to_string(mask.height) + ", the image " + std::to_string(image.width) +
                               "x" + std::to_string(image.height));
    return read;
  }

  void confirm_until(std::size_t end) {
    tbb::parallel_for(confirmed_, std::max(confirmed_, end), [&](std::size_t i) {
      confirm(clip_, i, depth_scale_, parameters_.vote.max_gap, parameters_.confirm, tracks_);
    });
    confirmed_ = std::max(confirmed_, end);
  }

  void finish_until(std::size_t end) {
    tbb::parallel_for(finished_, std::max(finished_, end), [&](std::size_t i) {
      finish_frame(clip_.at(i));
      on_frame_();
    });
    for (; finished_ < end; ++finished_) count(clip_.at(finished_));
  }

  void finish_frame(const ClipFrame& frame) {
    std::vector<SoftMask> soft = vote(clip_, frame.frame_idx, depth_scale_, parameters_.vote,
                                      [&](int track) { return may_appear(track, frame.frame_idx); });
    if (parameters_.snap.radius_px > 0 && !soft.empty()) {
      const Guide guide = guide_of(frame.depth, frame.color, depth_scale_, parameters_.snap.radius_px);
      for (SoftMask& mask : soft) snap(mask, guide, parameters_.snap.rounds);
    }
    InstanceMask mask = harden(soft, frame.color.size());
    FrameResult& result = results_[frame.frame_idx];
    if (parameters_.speeds && !frame.to_next.empty())
      result.moved =
          displacements(frame, clip_.at(frame.frame_idx + 1), mask, movers(mask), sequence_.camera(), rays_);
    for (const Instance& instance : mask.instances)
      result.repaired +=
          std::find(frame.track_of.begin(), frame.track_of.end(), instance.id - 1) == frame.track_of.end();
    writer_.write(frame.stamp, mask);
  }

  bool moves_by_itself(int track) const {
    const Label* label = labels_.find(tracks_[static_cast<std::size_t>(track)].class_name());
    return label && label->prior_dynamic;
  }

  /// Whether a track that a frame has not detected may be there: what moves by itself is also carried on
  /// beyond its first and last detection; other things only between two, or they would be dragged along by
  /// what passes in front of them. A frame in which nothing at all is detected denies nothing: into such a
  /// one they are carried from its `neighbors`.
  bool may_appear(int track, std::size_t frame_idx) const {
    if (moves_by_itself(track)) return true;
    const auto& frames = tracks_[static_cast<std::size_t>(track)].frames;
    const auto after = std::upper_bound(frames.begin(), frames.end(), frame_idx);
    const auto soon = [&](int reach) {
      return after != frames.end() && *after <= frame_idx + static_cast<std::size_t>(reach);
    };
    const auto lately = [&](int reach) {
      return after != frames.begin() && *std::prev(after) + static_cast<std::size_t>(reach) >= frame_idx;
    };
    const int max_gap = parameters_.vote.max_gap, neighbors = parameters_.vote.neighbors;
    if (soon(max_gap) && lately(max_gap)) return true;
    return clip_.at(frame_idx).detections.instances.empty() && (soon(neighbors) || lately(neighbors));
  }

  /// Ids of the instances that may move by themselves.
  std::vector<int> movers(const InstanceMask& mask) const {
    std::vector<int> ids;
    for (const Instance& instance : mask.instances)
      if (moves_by_itself(instance.id - 1)) ids.push_back(instance.id);
    return ids;
  }

  void count(const ClipFrame& frame) {
    ++counts_.frames;
    counts_.detections += frame.trusted.size();
    counts_.detections_dropped +=
        static_cast<std::size_t>(std::count(frame.trusted.begin(), frame.trusted.end(), false));
    for (std::size_t i = 0; i < frame.track_of.size(); ++i)
      detected_classes_.emplace_back(frame.track_of[i], frame.detections.instances[i].class_name);
    counts_.instances_repaired += results_[frame.frame_idx].repaired;
    counts_.frames_without_speeds += parameters_.speeds && results_[frame.frame_idx].moved.empty();
  }

  /// Classes and speeds are known when all frames are.
  void finish_writer() {
    std::map<int, std::map<std::size_t, Displacement>> moved;
    std::unordered_map<std::string, std::size_t> frame_by_stamp;
    for (std::size_t i = 0; i < results_.size(); ++i) {
      frame_by_stamp[sequence_.entry(i).stamp] = i;
      for (const auto& [id, displacement] : results_[i].moved) moved[id][i] = displacement;
    }
    std::map<int, std::map<std::size_t, double>> speed_of;
    for (const auto& [id, path] : moved) speed_of[id] = speeds(path);

    std::set<int> objects;
    writer_.finish([&](const std::string& stamp, Instance& instance) {
      objects.insert(instance.id);
      instance.class_name = tracks_[static_cast<std::size_t>(instance.id - 1)].class_name();
      const auto& path = speed_of[instance.id];
      if (const auto known = path.find(frame_by_stamp.at(stamp)); known != path.end())
        instance.speed_m_s = known->second;
    });
    counts_.objects = objects.size();
    for (const auto& [track, name] : detected_classes_)
      counts_.classes_corrected += tracks_[static_cast<std::size_t>(track)].class_name() != name;
  }

  const Sequence& sequence_;
  const MasksReader& masks_;
  const LabelTable& labels_;
  const Parameters& parameters_;
  MasksWriter& writer_;
  const std::function<void()>& on_frame_;
  std::vector<Ray> rays_;
  double depth_scale_;
  std::size_t reach_;  ///< frames on either side that a frame's masks depend on
  Clip clip_;
  std::vector<Track> tracks_;
  std::vector<FrameResult> results_;
  std::vector<std::pair<int, std::string>> detected_classes_;
  std::size_t confirmed_ = 0, finished_ = 0;
  Counts counts_;
};

}  // namespace

Counts repair_sequence(const Sequence& sequence, const MasksReader& masks, const LabelTable& labels,
                       const Parameters& parameters, MasksWriter& writer,
                       const std::function<void()>& on_frame) {
  return Repair(sequence, masks, labels, parameters, writer, on_frame).run();
}

}  // namespace sediment::repair
