#include "tests/tools/evaluate-map/small_room.hpp"

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/label_file.hpp"

namespace sediment::test {
namespace {

const cv::Rect kPersonPixels(27, 18, 10, 12);

/// x right, y down, z forward becomes x right, z up, y forward; 1 m above the ground.
Pose world_from_tiny() {
  Pose pose;
  pose.rotation = {1, 0, 0, 0, 0, 1, 0, -1, 0};
  pose.translation = {0, 0, 1};
  return pose;
}

LabelledPoint point_at(double x, double y, double z, std::uint32_t label) {
  LabelledPoint point;
  point.x = static_cast<float>(x);
  point.y = static_cast<float>(y);
  point.z = static_cast<float>(z);
  point.label = label;
  return point;
}

}  // namespace

SmallRoom::SmallRoom() {
  TinySequence sequence = tiny_sequence(3);
  for (StampedPose& pose : sequence.groundtruth)
    pose.world_from_camera = world_from_tiny() * pose.world_from_camera;
  sequence.frames[1].depth(kPersonPixels).setTo(5050);
  write_sequence(folder.path(), sequence);
  DynamicMasksWriter dynamic(folder / "truth" / "dynamic");
  for (const Frame& frame : sequence.frames) {
    cv::Mat mask(frame.depth.size(), CV_8UC1, cv::Scalar(0));
    if (frame.frame_idx == 1) mask(kPersonPixels).setTo(kPriorDynamic);
    dynamic.write(frame.stamp, mask, {});
  }
  dynamic.finish();
  write_cloud(folder / "truth" / "static_cloud", wall(), default_labels(), PcdEncoding::binary);
}

LabelledCloud SmallRoom::wall() const {
  LabelledCloud cloud;
  for (int x = -95; x < 95; ++x)
    for (int z = 30; z < 170; ++z) cloud.push_back(point_at(0.01 * x + 0.005, 2.0, 0.01 * z + 0.005, 62));
  return cloud;
}

LabelledCloud SmallRoom::person() const {
  const TinySequence tiny = tiny_sequence(2);
  LabelledCloud cloud;
  for (int v = kPersonPixels.y; v < kPersonPixels.br().y; ++v)
    for (int u = kPersonPixels.x; u < kPersonPixels.br().x; ++u) {
      const Vec3 in_camera = tiny.camera.back_project({static_cast<double>(u), static_cast<double>(v)}, 1.01);
      const Vec3 at = world_from_tiny() * (tiny.groundtruth[1].world_from_camera * in_camera);
      cloud.push_back(point_at(at.x, at.y, at.z, 0));
    }
  return cloud;
}

LabelledCloud moved(LabelledCloud cloud, const Pose& by) {
  for (LabelledPoint& point : cloud) {
    const Vec3 at = by * Vec3{point.x, point.y, point.z};
    point = [&, label = point.label] { return point_at(at.x, at.y, at.z, label); }();
  }
  return cloud;
}

LabelledCloud operator+(LabelledCloud a, const LabelledCloud& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace sediment::test
