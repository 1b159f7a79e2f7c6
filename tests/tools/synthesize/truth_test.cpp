#include <catch2/catch.hpp>
#include <set>

#include "pipeline/artifacts/label_file.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using namespace sediment::test;

TEST_CASE("static pixels of one frame reproject onto another by the true poses") {
  const SyntheticSequence s = synthetic_sequence(
      {.scene = "static", .frames = 3, .width = 320, .height = 240, .noise = false, .rate_hz = 3});
  const Pose second_from_first =
      s.groundtruth[2].world_from_camera.inverse() * s.groundtruth[0].world_from_camera;
  int seen = 0, agree = 0;
  for (int v = 0; v < s.camera.height; ++v)
    for (int u = 0; u < s.camera.width; ++u) {
      const Vec3 point = second_from_first *
                         s.camera.back_project({double(u), double(v)}, s.exact_depth_m[0].at<float>(v, u));
      if (point.z < 0.1) continue;
      const Pixel at = s.camera.project(point);
      const int x = static_cast<int>(std::lround(at.u)), y = static_cast<int>(std::lround(at.v));
      if (x < 0 || y < 0 || x >= s.camera.width || y >= s.camera.height) continue;
      ++seen;
      agree += std::abs(s.exact_depth_m[2].at<float>(y, x) - point.z) < 0.02;
    }
  CHECK(seen > 30000);
  CHECK(agree > 0.93 * seen);  // the rest is hidden in the other view
}

TEST_CASE("every class of the scene is in the label table") {
  const SyntheticSequence s = synthetic_sequence({.frames = 4, .rate_hz = 1});
  for (const InstanceMask& mask : s.instances)
    for (const Instance& instance : mask.instances) CHECK(default_labels().find(instance.class_name));
  std::set<std::uint32_t> labels;
  for (const LabelledPoint& point : s.static_cloud) labels.insert(point.label);
  CHECK(labels.count(kUnlabelled) == 0);
  CHECK(labels.count(100) == 1);  // wall
  CHECK(labels.count(62) == 1);   // tv
}

TEST_CASE("a person's pixels are dynamic, a pushed chair's only while it moves") {
  const SyntheticSequence s = synthetic_sequence({.frames = 5, .noise = false, .rate_hz = 1});
  bool chair_moved = false, chair_rested = false;
  for (std::size_t i = 0; i < s.frames.size(); ++i)
    for (int v = 0; v < s.camera.height; ++v)
      for (int u = 0; u < s.camera.width; ++u) {
        const int id = s.instances[i].ids.at<std::uint16_t>(v, u);
        const int dynamic = s.dynamic[i].at<std::uint8_t>(v, u);
        std::string name;
        for (const Instance& instance : s.instances[i].instances)
          if (instance.id == id) name = instance.class_name;
        if ((name == "person") != (dynamic == kPriorDynamic)) FAIL("person and dynamic mask differ");
        if (dynamic == kNonPriorDynamic && name != "chair") FAIL("only the chair may move");
        chair_moved |= dynamic == kNonPriorDynamic;
        chair_rested |= name == "chair" && dynamic == kStatic;
      }
  CHECK(chair_moved);
  CHECK(chair_rested);
}
