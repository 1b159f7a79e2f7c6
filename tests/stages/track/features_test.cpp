#include <catch2/catch.hpp>

#include "stages/track/features.hpp"
#include "stages/track/reliable_depth.hpp"
#include "tests/stages/track/box_room.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

cv::Mat gray_of(const Frame& frame) {
  cv::Mat gray;
  cv::extractChannel(frame.color, gray, 0);
  return gray;
}

}  // namespace

TEST_CASE("features cover every part of a textured image") {
  const Camera camera = small_camera();
  const Frame frame = record_box_room({Pose{}}, camera).frame(0);
  Parameters parameters;
  parameters.features = 800;
  const auto features = find_features(gray_of(frame), {}, camera, parameters.features);
  CHECK(features.size() > 700);
  CHECK(features.size() <= 810);
  int cells[4][4] = {};
  for (const Feature& f : features.features()) ++cells[int(f.v_px / 60)][int(f.u_px / 80)];
  for (const auto& row : cells)
    for (const int count : row) CHECK(count >= 10);
}

TEST_CASE("no feature lies on a dynamic pixel or within its halo") {
  const Camera camera = small_camera();
  const Frame frame = record_box_room({Pose{}}, camera).frame(0);
  cv::Mat mask(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(100, 80, 90, 70)) = kNonPriorDynamic;
  Parameters parameters;
  const auto features = find_features(gray_of(frame), allowed_pixels(mask, parameters.mask_halo_px), camera,
                                      parameters.features);
  CHECK(features.size() > 300);
  const int halo = parameters.mask_halo_px;
  for (const Feature& f : features.features())
    CHECK_FALSE(
        (f.u_px > 100 - halo && f.u_px < 190 + halo - 1 && f.v_px > 80 - halo && f.v_px < 150 + halo - 1));
}

TEST_CASE("the lens is undone: features of a distorted image lie where the pinhole camera sees them") {
  Camera straight = small_camera(), bent = straight;
  bent.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  Parameters parameters;
  const auto pinhole_features = [&](const Camera& camera) {
    const Frame frame = record_box_room({Pose{}}, camera).frame(0);
    return find_features(gray_of(frame), {}, camera, parameters.features);
  };
  const auto a = pinhole_features(straight), b = pinhole_features(bent);
  int near = 0;
  double sum_px = 0;
  for (const Feature& f : a.features()) {
    double nearest = 3;
    for (const Feature& g : b.features())
      if (f.octave == g.octave)
        nearest = std::min<double>(nearest, std::hypot(f.u_px - g.u_px, f.v_px - g.v_px));
    if (nearest == 3) continue;
    ++near;
    sum_px += nearest;
  }
  CHECK(near > 200);
  CHECK(sum_px / near < 1.2);  // left distorted, most would be several pixels off or find no partner
}

TEST_CASE("a search by place finds exactly the features that a scan of all finds") {
  const Camera camera = small_camera();
  const Frame frame = record_box_room({Pose{}}, camera).frame(0);
  const auto features = find_features(gray_of(frame), {}, camera, Parameters{}.features);
  std::vector<int> found;
  for (const auto& [u, v, radius] :
       {std::array<float, 3>{160, 120, 20}, {2, 3, 30}, {318, 238, 9}, {-5, 100, 40}}) {
    features.find_near(u, v, radius, 1, 3, found);
    std::vector<int> expected;
    for (int i = 0; i < static_cast<int>(features.size()); ++i) {
      const Feature& f = features.feature(i);
      if (f.octave >= 1 && f.octave <= 3 && std::abs(f.u_px - u) < radius && std::abs(f.v_px - v) < radius)
        expected.push_back(i);
    }
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  }
}

TEST_CASE("a black image and one of a single grey have no features") {
  const Camera camera = small_camera();
  for (const int grey : {0, 128}) {
    const cv::Mat image(camera.height, camera.width, CV_8UC1, cv::Scalar(grey));
    CHECK(find_features(image, {}, camera, Parameters{}.features).size() == 0);
  }
}

TEST_CASE("depth is the median of the pixels about, and nothing at an edge or a hole") {
  cv::Mat depth(9, 9, CV_16UC1, cv::Scalar(10000));
  depth.at<std::uint16_t>(4, 4) = 10030;
  CHECK(reliable_depth_m(depth, 4, 4, 5000, 0.0014) == 2.0);
  depth.at<std::uint16_t>(4, 5) = 15000;
  CHECK(reliable_depth_m(depth, 4, 4, 5000, 0.0014) == 0);
  depth.setTo(0);
  CHECK(reliable_depth_m(depth, 4, 4, 5000, 0.0014) == 0);
  CHECK(reliable_depth_m(depth, 0, 0, 5000, 0.0014) == 0);
}
