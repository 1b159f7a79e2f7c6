#include "stages/repair/link.hpp"

#include <catch2/catch.hpp>

#include "stages/repair/confirm.hpp"
#include "tests/stages/repair/moving_card.hpp"

using namespace sediment;
using namespace sediment::repair;
using namespace sediment::repair::test;

namespace {

std::vector<ClipFrame> frames_of(std::size_t count) {
  std::vector<ClipFrame> frames;
  for (std::size_t i = 0; i < count; ++i) frames.push_back(CardScene{}.frame(i));
  return frames;
}

std::vector<Track> link_all(Clip& clip, const LinkParameters& parameters = {}) {
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < clip.end_idx(); ++i) link(clip, i, kScale, parameters, tracks);
  return tracks;
}

void confirm_all(Clip& clip, const std::vector<Track>& tracks) {
  for (std::size_t i = 0; i < clip.end_idx(); ++i) confirm(clip, i, kScale, 12, {}, tracks);
}

}  // namespace

TEST_CASE("a card that moves is one track, also when its ids change from frame to frame") {
  auto frames = frames_of(8);
  for (std::size_t i = 0; i < 8; ++i) {
    const int id = 1 + static_cast<int>(i * 7 % 5);
    frames[i].detections.ids.setTo(id, frames[i].detections.ids > 0);
    frames[i].detections.instances[0].id = id;
  }
  Clip clip = clip_of(frames);
  const auto tracks = link_all(clip);
  REQUIRE(tracks.size() == 1);
  CHECK(tracks[0].frames.size() == 8);
  CHECK(tracks[0].class_name() == "person");
}

TEST_CASE("a track outlives a gap of up to max_gap frames and no longer") {
  auto frames = frames_of(12);
  for (std::size_t i = 3; i < 9; ++i) forget_detections(frames[i]);
  Clip clip = clip_of(frames);
  CHECK(link_all(clip, {.max_gap = 6}).size() == 1);
  CHECK(link_all(clip, {.max_gap = 5}).size() == 2);
}

TEST_CASE("a wrong class in between does not break a track, and the majority names it") {
  auto frames = frames_of(6);
  frames[2].detections.instances[0].class_name = "umbrella";
  Clip clip = clip_of(frames);
  const auto tracks = link_all(clip);
  REQUIRE(tracks.size() == 1);
  CHECK(tracks[0].class_name() == "person");
}

TEST_CASE("two detections of one frame never share a track") {
  auto frames = frames_of(2);
  frames[1].detections.ids(cv::Rect(20, 30, 40, 30)) = 2;
  frames[1].detections.instances.push_back({2, "person", 0.8});
  Clip clip = clip_of(frames);
  CHECK(link_all(clip).size() == 2);
  CHECK(clip.at(1).track_of[0] != clip.at(1).track_of[1]);
}

TEST_CASE("a detection that its neighbours contradict is not trusted, the others are") {
  auto frames = frames_of(7);
  frames[3].detections.ids(cv::Rect(100, 70, 30, 30)) = 2;
  frames[3].detections.instances.push_back({2, "person", 0.4});
  Clip clip = clip_of(frames);
  const auto tracks = link_all(clip);
  REQUIRE(tracks.size() == 2);
  confirm_all(clip, tracks);
  for (std::size_t i = 0; i < 7; ++i) CHECK(clip.at(i).trusted[0]);
  CHECK_FALSE(clip.at(3).trusted[1]);
}

TEST_CASE("a lonely detection between frames without any is trusted: nothing contradicts it") {
  auto frames = frames_of(5);
  for (const std::size_t i : {0, 1, 3, 4}) forget_detections(frames[i]);
  Clip clip = clip_of(frames);
  const auto tracks = link_all(clip);
  confirm_all(clip, tracks);
  CHECK(clip.at(2).trusted[0]);
}
