#include "tools/synthesize/truth_writer.hpp"

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "tools/synthesize/degraded_masks.hpp"
#include "tools/synthesize/depth_sensor.hpp"

namespace sediment::synthetic {
namespace {

std::filesystem::path made(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

TruthWriter::TruthWriter(const Recording& recording, std::filesystem::path folder, const Extras& extras)
    : recording_(recording),
      folder_(std::move(folder)),
      extras_(extras),
      missed_(missed_frames(recording.size(), {}, recording.seed())),
      instances_(made(folder_ / "instances")),
      dynamic_(made(folder_ / "dynamic")),
      surface_(recording.scene(), kCloudSpacing) {
  if (extras_.degraded_masks) degraded_ = std::make_unique<MasksWriter>(made(folder_ / "degraded_instances"));
  if (extras_.clean_depth) made(folder_ / "depth");
}

void TruthWriter::add(const RecordedFrame& f) {
  const std::string& stamp = f.frame.stamp;
  instances_.write(stamp, f.instances);
  dynamic_.write(stamp, f.dynamic, {});
  if (degraded_) {
    const InstanceMask nothing{cv::Mat(f.instances.ids.size(), CV_16UC1, cv::Scalar(0)), {}};
    degraded_->write(stamp, missed_[f.frame.frame_idx]
                                ? nothing
                                : degraded(f.instances, {}, recording_.seed(), f.frame.frame_idx));
  }
  if (extras_.clean_depth)
    write_png(folder_ / "depth" / (stamp + ".png"), encode_depth(f.exact.depth_m, recording_.camera()));
  const std::lock_guard lock(surface_mutex_);
  surface_.add(f.exact, f.moment, f.frame.depth);
}

void TruthWriter::finish() {
  instances_.finish();
  dynamic_.finish();
  if (degraded_) degraded_->finish();
  write_cloud(made(folder_ / "static_cloud"), surface_.cloud(recording_.lighting(), default_labels()),
              default_labels(), PcdEncoding::binary);
}

}  // namespace sediment::synthetic
