#include <catch2/catch.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <set>

#include "tools/synthesize/recording.hpp"

using namespace sediment;
using namespace sediment::synthetic;

namespace {

Recording recording_of(const std::string& scene, int frames, double rate_hz, int width, bool noise = false) {
  Settings settings;
  settings.scene = scene, settings.frames = frames, settings.rate_hz = rate_hz;
  settings.width = width, settings.height = width * 3 / 4;
  settings.noise = noise;
  return Recording(settings);
}

/// Cells of a grid of 5 x 4 with at least three features.
int cells_with_features(const std::vector<cv::KeyPoint>& features, cv::Size size) {
  int count[20] = {};
  for (const cv::KeyPoint& feature : features)
    ++count[static_cast<int>(feature.pt.y * 4 / size.height) * 5 +
            static_cast<int>(feature.pt.x * 5 / size.width)];
  return static_cast<int>(std::count_if(std::begin(count), std::end(count), [](int n) { return n >= 3; }));
}

double dynamic_share(const RecordedFrame& frame) {
  return cv::countNonZero(frame.dynamic) / static_cast<double>(frame.dynamic.total());
}

}  // namespace

TEST_CASE("the depth of the floor is that of the plane z = 0") {
  const Recording recording = recording_of("static", 3, 1, 160);
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const RecordedFrame f = recording.frame(i);
    int on_floor = 0;
    for (int v = 0; v < 120; ++v)
      for (int u = 0; u < 160; ++u) {
        const int solid = f.exact.solid.at<int>(v, u);
        REQUIRE(solid >= 0);  // the room is closed
        if (recording.scene().bodies[f.moment.solids[solid].body_idx].class_name != "floor") continue;
        const Vec3 ray =
            f.world_from_camera.rotate(recording.camera().back_project({double(u), double(v)}, 1));
        CHECK(f.exact.depth_m.at<float>(v, u) ==
              Approx(-f.world_from_camera.translation.z / ray.z).epsilon(1e-5));
        ++on_floor;
      }
    CHECK(on_floor > 1000);
  }
}

TEST_CASE("ORB finds features all over the image wherever the camera looks") {
  for (const auto& [scene, frames, rate] : {std::tuple{"static", 8, 0.8}, {"loop", 12, 12 / 30.0}}) {
    const Recording recording = recording_of(scene, frames, rate, 640, true);
    for (std::size_t i = 0; i < recording.size(); ++i) {
      std::vector<cv::KeyPoint> features;
      cv::Mat gray;
      cv::cvtColor(recording.frame(i).frame.color, gray, cv::COLOR_BGR2GRAY);
      cv::ORB::create(4000, 1.2f, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, 10)->detect(gray, features);
      INFO(scene << " frame " << i);
      CHECK(features.size() >= 700);
      CHECK(cells_with_features(features, gray.size()) >= 18);
    }
  }
}

TEST_CASE("`bare` has a corner here and there, in places few, and a person in some frames") {
  const Recording recording = recording_of("bare", 33, 3, 640, true);
  std::size_t fewest = 10000;
  int with_person = 0;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const RecordedFrame f = recording.frame(i);
    std::vector<cv::KeyPoint> features;
    cv::Mat gray;
    cv::cvtColor(f.frame.color, gray, cv::COLOR_BGR2GRAY);
    cv::ORB::create(4000)->detect(gray, features, f.dynamic == kStatic);
    fewest = std::min(fewest, features.size());
    with_person += dynamic_share(f) > 0.02;
  }
  CAPTURE(fewest, with_person);
  CHECK(fewest > 50);
  CHECK(fewest <= 100);
  CHECK(with_person >= 5);
  CHECK(with_person <= 25);
}

TEST_CASE("in the middle second of `crowd` people hide more than 60 % of the image of a rolled camera") {
  const Recording recording = recording_of("crowd", 60, 6, 80);
  int covered = 0, rolled = 0;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    covered += dynamic_share(recording.frame(i)) > 0.6;
    const Vec3 right = recording.world_from_camera(i).rotate({1, 0, 0});
    rolled += std::abs(right.z) > std::sin(70 * 3.14159 / 180);
  }
  CHECK(covered >= 6);
  CHECK(rolled >= 6);
  CHECK(dynamic_share(recording.frame(0)) < 0.3);
}

TEST_CASE("`loop` sees all four walls and ends where it began") {
  const Recording recording = recording_of("loop", 16, 16 / 30.0, 80);
  std::set<std::string> walls;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const RecordedFrame f = recording.frame(i);
    for (const int solid : cv::Mat_<int>(f.exact.solid))
      walls.insert(recording.scene().bodies[f.moment.solids[solid].body_idx].name);
  }
  for (const char* wall : {"back wall", "front wall", "left wall", "right wall"})
    CHECK(walls.count(wall) == 1);

  const Recording whole = recording_of("loop", 900, 30, 80);
  const Pose first = whole.world_from_camera(0), last = whole.world_from_camera(899),
             half = whole.world_from_camera(450);
  CHECK(norm(last.translation - first.translation) < 0.25);
  CHECK(rotation_angle(first.inverse() * last) < 0.25);
  CHECK(norm(half.translation - first.translation) > 1);
}

TEST_CASE(
    "`kidnapped` is black for a fifth of the frames and resumes elsewhere, in sight of the same things") {
  const Recording recording = recording_of("kidnapped", 20, 2, 80);
  int black = 0;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const RecordedFrame f = recording.frame(i);
    const bool dark = cv::countNonZero(f.frame.depth) == 0;
    CHECK(dark == (cv::mean(f.frame.color)[0] < 5));
    CHECK(dark == f.instances.instances.empty());
    CHECK(dark == (i >= 8 && i < 12));
    black += dark;
  }
  CHECK(black == 4);
  CHECK(norm(recording.world_from_camera(12).translation - recording.world_from_camera(7).translation) > 0.3);
}

TEST_CASE("the accelerometer says where up is") {
  const Recording recording = recording_of("walking", 10, 1, 80);
  for (const double time_s : {0.5, 3.0, 7.7}) {
    // Over some seconds the motion's own acceleration cancels nearly.
    Vec3 up_in_world;
    for (int i = 0; i < 1000; ++i) {
      const Pose pose = recording.world_from_camera_at(time_s + i * 0.005);
      up_in_world = up_in_world + pose.rotate(recording.accelerometer(time_s + i * 0.005)) / 1000;
    }
    CHECK(norm(up_in_world - Vec3{0, 0, 9.81}) < 0.15);
  }
}

TEST_CASE("an unknown scene is refused with the nearest name") {
  try {
    recording_of("walkng", 3, 1, 80);
    FAIL("accepted");
  } catch (const std::invalid_argument& error) {
    CHECK_THAT(error.what(), Catch::Contains("walkng") && Catch::Contains("did you mean 'walking'"));
  }
  CHECK_THROWS_AS(recording_of("static", 3, 1, 4), std::invalid_argument);
  CHECK_THROWS_AS(recording_of("static", 3, 0, 80), std::invalid_argument);
}

TEST_CASE("another seed gives other pictures and another way, the same seed the same") {
  Settings settings;
  settings.scene = "walking", settings.frames = 1, settings.width = 80, settings.height = 60;
  const Recording first(settings), again(settings);
  settings.seed = 2;
  const Recording other(settings);
  CHECK(cv::norm(first.frame(0).frame.color, again.frame(0).frame.color, cv::NORM_INF) == 0);
  CHECK(cv::norm(first.frame(0).frame.color, other.frame(0).frame.color, cv::NORM_INF) > 50);
  CHECK(norm(first.world_from_camera(0).translation - other.world_from_camera(0).translation) > 0.01);
}
