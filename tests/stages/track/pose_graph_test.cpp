#include <catch2/catch.hpp>

#include "stages/track/pose_graph.hpp"

using namespace sediment;
using namespace sediment::track;

TEST_CASE("a pose graph spreads the error of a loop evenly over its edges") {
  // A line of 11 cameras, each measured 10 mm too far from the last, and one that knows the true distance of
  // the ends.
  PoseGraph graph;
  for (int i = 0; i <= 10; ++i) {
    Pose pose;
    pose.translation.x = 0.11 * i;
    graph.camera_from_world.push_back(pose);
    graph.fixed.push_back(i == 0);
    if (i > 0)
      graph.edges.push_back(
          {i - 1, i, graph.camera_from_world[i] * graph.camera_from_world[i - 1].inverse()});
  }
  Pose loop;
  loop.translation.x = 1;
  graph.edges.push_back({0, 10, loop, 1});
  relax(graph);
  // Eleven edges share 0.1 m: each takes 1/11 of it.
  for (int i = 0; i <= 10; ++i)
    CHECK(graph.camera_from_world[i].translation.x == Approx(i * (0.11 - 0.1 / 11)).margin(1e-9));
}

TEST_CASE("a pose graph whose edges agree stays as it is") {
  PoseGraph graph;
  for (int i = 0; i < 6; ++i) {
    Pose pose = rotation_from({0.1 * i, 0.2 * i, -0.1 * i});
    pose.translation = {0.1 * i, 0.2, 0.05 * i * i};
    graph.camera_from_world.push_back(pose);
    graph.fixed.push_back(i == 0);
  }
  const auto truth = graph.camera_from_world;
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j) graph.edges.push_back({i, j, truth[j] * truth[i].inverse(), 1});
  for (int i = 1; i < 6; ++i) graph.camera_from_world[i].translation.y += 0.03 * i;
  relax(graph);
  for (int i = 0; i < 6; ++i) {
    CHECK(norm(graph.camera_from_world[i].translation - truth[i].translation) < 1e-7);
    CHECK(rotation_angle(graph.camera_from_world[i] * truth[i].inverse()) < 1e-6);
  }
}
