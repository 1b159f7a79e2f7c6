#include "stages/segment/given_source.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <stdexcept>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/nearest_name.hpp"
#include "stages/segment/given_files.hpp"

namespace sediment::segment {
namespace {

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

class GivenSource final : public MaskSource {
 public:
  GivenSource(const Parameters& parameters, const Sequence& sequence, const std::filesystem::path& masks)
      : parameters_(parameters),
        sequence_(sequence),
        files_(open_given_files(masks, parameters.given_class)) {
    std::size_t first = sequence.size();
    for (std::size_t frame_idx = sequence.size(); frame_idx-- > 0;)
      if (!files_->has(sequence.entry(frame_idx))) {
        first = frame_idx;
        ++missing_;
      }
    if (missing_ == 0) return;
    const std::string found = std::to_string(missing_) + " of " + std::to_string(sequence.size()) +
                              " frames have no mask, the first is " + sequence.entry(first).stamp;
    if (missing_ == sequence.size())
      throw std::runtime_error(masks.string() + ": no frame of the sequence has a mask (the first is " +
                               sequence.entry(first).stamp +
                               "): masks are named as the colour image or its stamp");
    if (parameters.missing == Missing::error)
      throw std::runtime_error(masks.string() + ": " + found + " (--missing empty takes them as empty)");
  }

  InstanceMask masks_of(std::size_t frame_idx) const override {
    const SequenceEntry& entry = sequence_.entry(frame_idx);
    const cv::Size image(sequence_.camera().width, sequence_.camera().height);
    if (!files_->has(entry)) return {cv::Mat::zeros(image, CV_16UC1), {}};
    InstanceMask mask = files_->read(entry);
    if (mask.ids.size() != image)
      throw std::runtime_error(files_->name(entry) + ": expected masks of " + size_text(image) +
                               " pixels as the camera says, found " + size_text(mask.ids.size()));
    check_classes(mask, entry);
    if (!parameters_.classes.empty()) keep_wanted(mask);
    return mask;
  }

  std::string engine() const override { return "given"; }
  std::size_t missing() const override { return missing_; }

 private:
  void check_classes(const InstanceMask& mask, const SequenceEntry& entry) const {
    if (parameters_.unknown_classes == Unknown::keep) return;
    for (const Instance& instance : mask.instances) {
      if (default_labels().find(instance.class_name) != nullptr) continue;
      std::vector<std::string> known;
      for (const Label& label : default_labels().labels()) known.push_back(label.name);
      const std::string nearest = contract::nearest_name(instance.class_name, known);
      throw std::runtime_error(files_->name(entry) + ": frame " + entry.stamp + ": instance " +
                               std::to_string(instance.id) + " is of the unknown class \"" +
                               instance.class_name + "\"" +
                               (nearest.empty() ? "" : ", is it \"" + nearest + "\"?") +
                               " (--unknown-classes keep takes it as it is)");
    }
  }

  void keep_wanted(InstanceMask& mask) const {
    std::vector<bool> wanted(65536, false);
    std::erase_if(mask.instances, [&](const Instance& instance) {
      const bool keep =
          std::ranges::find(parameters_.classes, instance.class_name) != parameters_.classes.end();
      wanted[static_cast<std::size_t>(instance.id)] = keep;
      return !keep;
    });
    std::for_each(mask.ids.begin<std::uint16_t>(), mask.ids.end<std::uint16_t>(),
                  [&](std::uint16_t& id) { id = wanted[id] ? id : std::uint16_t{0}; });
  }

  Parameters parameters_;
  const Sequence& sequence_;
  std::unique_ptr<GivenFiles> files_;
  std::size_t missing_ = 0;
};

}  // namespace

std::unique_ptr<MaskSource> open_given_source(const Parameters& parameters, const Sequence& sequence,
                                              const std::filesystem::path& masks) {
  return std::make_unique<GivenSource>(parameters, sequence, masks);
}

}  // namespace sediment::segment
