#include "stages/interaction-mask/mask_sequence.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "stages/interaction-mask/halo.hpp"
#include "stages/interaction-mask/preview.hpp"

namespace sediment::interaction_mask {
namespace {

std::vector<Interaction> interactions_of(const TouchedFrame& frame, const std::vector<Instance>& instances) {
  std::map<int, std::string> class_of;
  for (const Instance& instance : instances) class_of[instance.id] = instance.class_name;
  std::vector<Interaction> interactions;
  for (const PairTest& pair : frame.pairs)
    interactions.push_back({pair.dynamic_id, pair.static_id, class_of[pair.dynamic_id],
                            class_of[pair.static_id], pair.pixel_pairs, pair.mean_depth_difference_m,
                            pair.interacting});
  return interactions;
}

bool any_speed(const std::vector<std::vector<ObjectState>>& objects) {
  return std::any_of(objects.begin(), objects.end(), [](const auto& frame) {
    return std::any_of(frame.begin(), frame.end(),
                       [](const auto& state) { return state.speed_m_s.has_value(); });
  });
}

class Masking {
 public:
  Masking(const Sequence& sequence, const std::filesystem::path& masks, const LabelTable& labels,
          const Parameters& parameters, const std::filesystem::path& out,
          const std::function<void()>& on_frame)
      : sequence_(sequence),
        folder_(masks),
        masks_(masks),
        labels_(labels),
        parameters_(parameters),
        out_(out),
        on_frame_(on_frame),
        writer_(out),
        frames_(sequence.size()),
        dynamic_pixels_(sequence.size()) {
    if (parameters_.preview) std::filesystem::create_directories(out_ / "preview");
  }

  Counts run() {
    // What moves is known only when all frames have been looked at; what touches, at once.
    for_each_frame([&](std::size_t i) {
      const InstanceMask mask = masks_.read(stamp_of(i));
      const cv::Mat depth = sequence_.depth(i);
      try {
        frames_[i] = find_touched(mask, depth, sequence_.camera().depth_scale, labels_, parameters_.touch);
      } catch (const std::invalid_argument& error) {
        throw std::runtime_error(folder_.string() + ": frame " + stamp_of(i) + ": " + error.what());
      }
      if (!parameters_.motion) write(i, mask.ids, depth, frames_[i].touched_ids);
    });
    std::vector<std::set<int>> moved;
    bool speeds_known = false;
    if (parameters_.motion) {
      const auto objects = states();
      speeds_known = any_speed(objects);
      moved = moved_objects(objects, parameters_.motions);
      for_each_frame(
          [&](std::size_t i) { write(i, masks_.read(stamp_of(i)).ids, sequence_.depth(i), moved[i]); });
    }
    writer_.finish();
    Counts counts = count(moved);
    counts.speeds_unknown = parameters_.motion && !speeds_known && counts.non_prior_dynamic_instances > 0;
    return counts;
  }

 private:
  const std::string& stamp_of(std::size_t i) const { return sequence_.entry(i).stamp; }

  template <class Work>
  void for_each_frame(const Work& work) const {
    tbb::parallel_for(std::size_t{0}, sequence_.size(), work);
  }

  /// The prior static objects of every frame.
  std::vector<std::vector<ObjectState>> states() const {
    std::vector<std::vector<ObjectState>> states(sequence_.size());
    for (std::size_t i = 0; i < states.size(); ++i)
      for (const Instance& instance : masks_.instances(stamp_of(i))) {
        const auto& movers = frames_[i].prior_dynamic_ids;
        if (std::find(movers.begin(), movers.end(), instance.id) == movers.end())
          states[i].push_back(
              {instance.id, instance.speed_m_s, frames_[i].touched_ids.contains(instance.id)});
      }
    return states;
  }

  void write(std::size_t i, const cv::Mat& ids, const cv::Mat& depth, const std::set<int>& moved) {
    const double depth_scale = sequence_.camera().depth_scale;
    const cv::Mat dynamic = grow_over_halo(paint_dynamic(ids, frames_[i].prior_dynamic_ids, moved), depth,
                                           depth_scale, parameters_.halo_px);
    dynamic_pixels_[i] = static_cast<std::uint64_t>(cv::countNonZero(dynamic));
    writer_.write(stamp_of(i), dynamic, interactions_of(frames_[i], masks_.instances(stamp_of(i))));
    if (parameters_.preview)
      write_png(out_ / "preview" / (stamp_of(i) + ".png"),
                preview_of(sequence_.color(i), depth, depth_scale, dynamic));
    on_frame_();
  }

  Counts count(const std::vector<std::set<int>>& moved) const {
    Counts counts;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const TouchedFrame& frame = frames_[i];
      counts.prior_dynamic_instances += frame.prior_dynamic_ids.size();
      counts.non_prior_dynamic_instances += parameters_.motion ? moved[i].size() : frame.touched_ids.size();
      counts.pairs_in_reach += frame.pairs.size();
      for (const PairTest& pair : frame.pairs) counts.pairs_interacting += pair.interacting;
      counts.dynamic_pixels += dynamic_pixels_[i];
      for (const std::string& name : frame.unlisted) ++counts.unlisted_classes[name];
    }
    return counts;
  }

  const Sequence& sequence_;
  std::filesystem::path folder_;
  MasksReader masks_;
  const LabelTable& labels_;
  const Parameters& parameters_;
  std::filesystem::path out_;
  const std::function<void()>& on_frame_;
  DynamicMasksWriter writer_;
  std::vector<TouchedFrame> frames_;
  std::vector<std::uint64_t> dynamic_pixels_;
};

}  // namespace

Counts mask_sequence(const Sequence& sequence, const std::filesystem::path& masks, const LabelTable& labels,
                     const Parameters& parameters, const std::filesystem::path& out,
                     const std::function<void()>& on_frame) {
  return Masking(sequence, masks, labels, parameters, out, on_frame).run();
}

}  // namespace sediment::interaction_mask
