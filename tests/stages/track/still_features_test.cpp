#include <catch2/catch.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/stages/track/box_room.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

constexpr std::size_t kFrames = 90;
const cv::Rect kMasked(20, 20, 140, 200);  // of 320 x 240

Recording masked_recording(const std::vector<Pose>& truth) {
  Trouble kinect;
  kinect.depth_noise = 0.0014;
  Recording recording = record_box_room(truth, small_camera(), kinect);
  recording.dynamic_mask = [](std::size_t) {
    cv::Mat mask(240, 320, CV_8UC1, cv::Scalar(0));
    mask(kMasked) = 1;
    return mask;
  };
  return recording;
}

/// Under the mask a textured board 1.2 m ahead that slides by `speed_px` a frame.
Recording with_sliding_board(const std::vector<Pose>& truth, double speed_px) {
  cv::Mat small(60, 400, CV_8UC3), board;
  cv::RNG random(7);
  random.fill(small, cv::RNG::UNIFORM, 0, 256);
  cv::resize(small, board, {}, 5, 5, cv::INTER_LINEAR);
  Recording recording = masked_recording(truth);
  const auto behind = recording.frame;
  recording.frame = [=](std::size_t i) {
    Frame frame = behind(i);
    const int shift = static_cast<int>(speed_px * static_cast<double>(i));
    board(cv::Rect(shift, 20, kMasked.width, kMasked.height)).copyTo(frame.color(kMasked));
    frame.depth(kMasked) = 1.2 * small_camera().depth_scale;
    return frame;
  };
  recording.depth = [frame = recording.frame](std::size_t i) { return frame(i).depth; };
  return recording;
}

Tracked track_with(const Recording& recording, bool still_features) {
  Parameters parameters;
  parameters.features = 700;
  parameters.still_features = still_features;
  parameters.smoothing = false;  // it would hide what the features do to single poses
  return track::track(recording, parameters, {});
}

}  // namespace

TEST_CASE("what holds still under a mask serves after all") {
  const auto truth = swaying_poses(kFrames, 0.3, 0.4);
  const auto recording = masked_recording(truth);
  const auto with = track_with(recording, true), without = track_with(recording, false);
  CHECK(with.still_landmarks > 100);
  CHECK(without.still_landmarks == 0);
  CHECK(position_error_m(with, truth) < position_error_m(without, truth));
}

TEST_CASE("what moves under a mask stays out, slow or fast") {
  const auto truth = swaying_poses(kFrames, 0.3, 0.4);
  for (const double speed_px : {0.5, 3.0}) {
    const auto recording = with_sliding_board(truth, speed_px);
    const auto with = track_with(recording, true), without = track_with(recording, false);
    CHECK(with.still_landmarks < 10);
    CHECK(position_error_m(with, truth) < 1.05 * position_error_m(without, truth));
  }
}
