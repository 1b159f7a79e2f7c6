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

TEST_CASE(
    "points of the static cloud lie on static pixels of their own instance, and nearly all are seen again") {
  const SyntheticSequence s =
      synthetic_sequence({.frames = 6, .width = 320, .height = 240, .noise = false, .rate_hz = 1.5});
  REQUIRE(s.static_cloud.size() > 50000);
  std::size_t seen = 0, dynamic = 0, other_instance = 0, sightings = 0;
  for (const LabelledPoint& point : s.static_cloud) {
    bool found = false;
    for (std::size_t i = 0; i < s.frames.size(); ++i) {
      const Vec3 in_camera = s.groundtruth[i].world_from_camera.inverse() * Vec3{point.x, point.y, point.z};
      if (in_camera.z < 0.1) continue;
      const Pixel at = s.camera.project(in_camera);
      const int u = static_cast<int>(std::lround(at.u)), v = static_cast<int>(std::lround(at.v));
      if (u < 0 || v < 0 || u >= s.camera.width || v >= s.camera.height) continue;
      if (std::abs(s.exact_depth_m[i].at<float>(v, u) - in_camera.z) > 0.01) continue;
      found = true;
      ++sightings;
      dynamic += s.dynamic[i].at<std::uint8_t>(v, u) != kStatic;
      // Ids are those of bodies; what networks do not know has none.
      const std::uint32_t id = s.instances[i].ids.at<std::uint16_t>(v, u);
      other_instance += id != 0 && id != point.instance;
    }
    seen += found;
  }
  CHECK(seen > 0.97 * s.static_cloud.size());
  CHECK(dynamic < 0.002 * sightings);  // a pixel's rounding at the edge of a foot
  CHECK(other_instance < 0.01 * sightings);
}

TEST_CASE("nothing that ever moves is in the static cloud") {
  const SyntheticSequence s =
      synthetic_sequence({.frames = 6, .width = 160, .height = 120, .noise = false, .rate_hz = 1.5});
  std::set<std::uint32_t> moving;
  for (std::size_t i = 0; i < s.frames.size(); ++i)
    for (int v = 0; v < s.camera.height; ++v)
      for (int u = 0; u < s.camera.width; ++u)
        if (s.dynamic[i].at<std::uint8_t>(v, u) != kStatic)
          moving.insert(s.instances[i].ids.at<std::uint16_t>(v, u));
  CHECK(moving.size() == 3);  // two people and a chair
  for (const LabelledPoint& point : s.static_cloud) CHECK(moving.count(point.instance) == 0);
}

TEST_CASE("boxes of instances are the bounds of their pixels") {
  const SyntheticSequence s = synthetic_sequence({.frames = 2, .rate_hz = 1});
  for (const InstanceMask& mask : s.instances)
    for (const Instance& instance : mask.instances) {
      std::array<double, 4> box{1e9, 1e9, -1, -1};
      for (int v = 0; v < mask.ids.rows; ++v)
        for (int u = 0; u < mask.ids.cols; ++u)
          if (mask.ids.at<std::uint16_t>(v, u) == instance.id)
            box = {std::min(box[0], double(u)), std::min(box[1], double(v)), std::max(box[2], u + 1.0),
                   std::max(box[3], v + 1.0)};
      CHECK(box == instance.box_px);
    }
}

TEST_CASE("a carried box rests on the desks before and after and is dynamic between") {
  // Frames at 0.3, then every 1.3 seconds: picked up at 0.8, put down at 6.2.
  const SyntheticSequence s = synthetic_sequence(
      {.scene = "carried-box", .frames = 8, .width = 320, .height = 240, .noise = false, .rate_hz = 1 / 1.3});
  for (std::size_t i = 0; i < s.frames.size(); ++i) {
    std::uint32_t dynamic_pixels = 0, box_id = 0;
    for (int v = 0; v < s.camera.height; ++v)
      for (int u = 0; u < s.camera.width; ++u)
        if (s.dynamic[i].at<std::uint8_t>(v, u) == kNonPriorDynamic) {
          ++dynamic_pixels;
          box_id = s.instances[i].ids.at<std::uint16_t>(v, u);
        }
    const double time_s = 1.3 * static_cast<double>(i);
    INFO("at " << time_s);
    CHECK((dynamic_pixels > 0) <= (time_s > 0.8 && time_s < 6.2));
    for (const Instance& instance : s.instances[i].instances)
      if (instance.id == static_cast<int>(box_id)) CHECK(instance.class_name == "box");
    if (time_s > 2 && time_s < 5) CHECK(dynamic_pixels > 200);
  }
}
