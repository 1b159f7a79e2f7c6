#include "stages/repair/vote.hpp"

#include <catch2/catch.hpp>

#include "stages/repair/snap.hpp"
#include "tests/stages/repair/moving_card.hpp"

using namespace sediment;
using namespace sediment::repair;
using namespace sediment::repair::test;

namespace {

const CardScene kScene;

/// All detections are of track 0 and trusted.
Clip clip_with(std::size_t count, const std::function<void(ClipFrame&)>& change) {
  std::vector<ClipFrame> frames;
  for (std::size_t i = 0; i < count; ++i) {
    frames.push_back(kScene.frame(i));
    change(frames.back());
    frames.back().track_of.assign(frames.back().detections.instances.size(), 0);
    frames.back().trusted.assign(frames.back().detections.instances.size(), true);
  }
  return clip_of(std::move(frames));
}

cv::Mat truth(std::size_t frame_idx) {
  cv::Mat mask(120, 160, CV_8UC1, cv::Scalar(0));
  mask(kScene.card_at(frame_idx)) = 255;
  return mask;
}

/// A detection whose outline is `off_px` outside (inside, if negative) the card's.
void detect_off_by(ClipFrame& frame, int off_px) {
  const cv::Rect at = kScene.card_at(frame.frame_idx);
  frame.detections.ids = 0;
  frame.detections.ids(
      cv::Rect(at.x - off_px, at.y - off_px, at.width + 2 * off_px, at.height + 2 * off_px)) = 1;
}

InstanceMask voted(const Clip& clip, std::size_t frame_idx, const VoteParameters& parameters, int snap_px,
                   bool may_appear = true) {
  auto masks = vote(clip, frame_idx, kScale, parameters, [&](int) { return may_appear; });
  const ClipFrame& frame = clip.at(frame_idx);
  const Guide guide = guide_of(frame.depth, frame.color, kScale, snap_px);
  for (SoftMask& mask : masks) snap(mask, guide, SnapParameters{}.rounds);
  return harden(masks, frame.color.size());
}

}  // namespace

TEST_CASE("detections that were missed are repaired from both sides") {
  const Clip clip = clip_with(12, [](ClipFrame& frame) {
    if (frame.frame_idx >= 3 && frame.frame_idx < 9) forget_detections(frame);
  });
  for (std::size_t i = 3; i < 9; ++i) {
    INFO("frame " << i);
    const InstanceMask mask = voted(clip, i, {}, 8);
    REQUIRE(mask.instances.size() == 1);
    CHECK(mask.instances[0].id == 1);
    CHECK(mask.instances[0].score == Approx(0.9));
    CHECK(overlap(mask.ids > 0, truth(i)) > 0.95);
  }
}

TEST_CASE("nothing is repaired with a gap of 0, beyond the gap, or where a track may not appear") {
  const Clip clip = clip_with(8, [](ClipFrame& frame) {
    if (frame.frame_idx > 0) forget_detections(frame);
  });
  CHECK(voted(clip, 2, {.max_gap = 2}, 0).instances.size() == 1);
  CHECK(voted(clip, 2, {.max_gap = 0}, 0).instances.empty());
  CHECK(voted(clip, 5, {.max_gap = 4}, 0).instances.empty());
  CHECK(voted(clip, 2, {.max_gap = 4}, 0, false).instances.empty());
}

TEST_CASE("a detection that is not trusted neither stays nor votes") {
  Clip clip = clip_with(3, [](ClipFrame&) {});
  for (std::size_t i = 0; i < 3; ++i) clip.at(i).trusted[0] = false;
  CHECK(voted(clip, 1, {}, 8).instances.empty());
}

TEST_CASE("without neighbours and snapping a mask stays as it was, to the grid") {
  const Clip clip = clip_with(3, [](ClipFrame&) {});
  const InstanceMask mask = voted(clip, 1, {.max_gap = 0, .neighbors = 0}, 0);
  CHECK(overlap(mask.ids > 0, truth(1)) > 0.97);
  REQUIRE(mask.instances.size() == 1);
  CHECK(mask.instances[0].box_px[0] == Approx(22).margin(1));
  CHECK(mask.instances[0].box_px[3] == Approx(90).margin(1));
}

TEST_CASE("an outline that is three pixels off snaps to the edge of the depth") {
  const int off_px = GENERATE(-3, 3);
  const Clip clip = clip_with(1, [&](ClipFrame& frame) { detect_off_by(frame, off_px); });
  const double before = overlap(clip.at(0).detections.ids > 0, truth(0));
  const double after = overlap(voted(clip, 0, {}, SnapParameters{}.radius_px).ids > 0, truth(0));
  INFO(off_px << " px: " << before << " -> " << after);
  CHECK(before < 0.8);
  CHECK(after > 0.95);
}

TEST_CASE("detections that are too small and too large by up to six pixels come out right together") {
  const int off_px[] = {5, -6, -2, 6, 3, -4, -5, 1, 4};
  const Clip clip = clip_with(9, [&](ClipFrame& frame) { detect_off_by(frame, off_px[frame.frame_idx]); });
  for (std::size_t i = 0; i < 9; ++i) {
    INFO("frame " << i << ", off by " << off_px[i] << " px");
    CHECK(overlap(voted(clip, i, {}, SnapParameters{}.radius_px).ids > 0, truth(i)) > 0.93);
  }
}

TEST_CASE("of two tracks the surer one gets a pixel") {
  std::vector<SoftMask> masks;
  masks.push_back({3, 0.5, {0, 0, 4, 1}, (cv::Mat_<float>(1, 4) << 0.9F, 0.6F, 0.4F, 0.7F)});
  masks.push_back({5, 0.5, {1, 0, 3, 1}, (cv::Mat_<float>(1, 3) << 0.8F, 0.45F, 0.7F)});
  const InstanceMask mask = harden(masks, {4, 1});
  CHECK(mask.ids.at<std::uint16_t>(0, 0) == 4);
  CHECK(mask.ids.at<std::uint16_t>(0, 1) == 6);
  CHECK(mask.ids.at<std::uint16_t>(0, 2) == 0);
  CHECK(mask.ids.at<std::uint16_t>(0, 3) == 4);
  CHECK(mask.instances.size() == 2);
}
