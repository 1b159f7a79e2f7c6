#include "stages/track/diagnosis.hpp"

#include <catch2/catch.hpp>

#include "stages/track/diagnosis_pictures.hpp"
#include "tests/stages/track/box_room.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

Tracked tracked(const Recording& recording) {
  Parameters parameters;
  parameters.features = 700;
  return track::track(recording, parameters, {});
}

}  // namespace

TEST_CASE("the summary says where frames were lost and how well the map fits") {
  Trouble trouble;
  trouble.black = trouble.no_depth = [](std::size_t i) { return i >= 10 && i < 14; };
  const Recording recording = record_box_room(swaying_poses(30, 0.3, 0.4), small_camera(), trouble);
  const std::string text = summary_of(tracked(recording));
  CHECK_THAT(text, Catch::StartsWith("26 of 30 frames have a pose (86.7 %)"));
  CHECK_THAT(text, Catch::Contains(recording.stamps[10] + " .. " + recording.stamps[13] + ": 4 frames"));
  CHECK_THAT(text, Catch::Contains("reprojection error 0."));
}

TEST_CASE("inverse depths of a recording with the sensor's noise err as the noise model says") {
  Trouble kinect;
  kinect.depth_noise = 0.0014;
  const Tracked result = tracked(record_box_room(swaying_poses(60, 0.3, 0.4), small_camera(), kinect));
  double squares = 0;
  for (const float error : result.diagnosis.depth_error) squares += static_cast<double>(error) * error;
  REQUIRE(result.diagnosis.depth_error.size() > 1000);
  // Depth is the median of 3 x 3 pixels, whose noise is independent here: less than that of one pixel.
  const double deviation = std::sqrt(squares / static_cast<double>(result.diagnosis.depth_error.size()));
  CHECK(deviation > 0.2);
  CHECK(deviation < 1);
}

TEST_CASE("features that landmarks hold are green, the others grey, and dynamic pixels are tinted") {
  const cv::Mat color(40, 60, CV_8UC3, cv::Scalar::all(100));
  cv::Mat dynamic(40, 60, CV_8UC1, cv::Scalar(0));
  dynamic.at<std::uint8_t>(2, 2) = kPriorDynamic;
  const cv::Mat picture = features_picture(color, dynamic, {0, {{20, 20, true}, {45, 20, false}}});
  const auto at = [&](int row, int column) { return picture.at<cv::Vec3b>(row, column); };
  CHECK(at(20, 23)[1] > at(20, 23)[2] + 50);
  CHECK(std::abs(at(20, 47)[1] - at(20, 47)[2]) < 5);
  CHECK(at(2, 2)[2] > 110);
  CHECK(at(35, 5) == cv::Vec3b(100, 100, 100));
}
