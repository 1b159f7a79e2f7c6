#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/project2d/grid_projection.hpp"
#include "stages/project2d/ground_search.hpp"
#include "stages/project2d/up_hint.hpp"

using namespace sediment;
using namespace sediment::contract;
using namespace sediment::project2d;

namespace {

struct Parameters {
  std::string ground, up;
  GroundParameters search;
  GridParameters grid;
};

std::optional<UpHint> hint_of(const Work& work, const Parameters& parameters) {
  if (!parameters.up.empty()) return parse_up(parameters.up);
  if (work.has("trajectory")) return up_from_trajectory(read_trajectory(work.in("trajectory")));
  return std::nullopt;
}

Ground ground_of(const Work& work, const LabelledCloud& cloud, const Parameters& parameters) {
  if (parameters.ground.empty()) return find_ground(cloud, hint_of(work, parameters), parameters.search);
  return {parse_plane(parameters.ground), "given", true};
}

Json metrics_of(const Ground& ground, const GridMap& map, const GridStatistics& statistics) {
  return {{"ground",
           {{"source", ground.source},
            {"is_floor", ground.floor},
            {"area_m2", ground.area_m2},
            {"share_below", ground.below},
            {"rms_m", ground.rms_m}}},
          {"points_below", statistics.points_below},
          {"points_in_band", statistics.points_in_band},
          {"points_above", statistics.points_above},
          {"points_not_finite", statistics.not_finite},
          {"width", map.width},
          {"height", map.height},
          {"cells_occupied", statistics.occupied},
          {"cells_free", statistics.free},
          {"cells_unknown", statistics.unknown}};
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  GridParameters& grid = parameters.grid;
  Stage stage("project2d", "Finds the ground and projects what stands on it to a navigation grid");
  stage.reads("cloud", kind::kCloud, "cloud to project");
  stage.reads_optional("trajectory", kind::kTrajectory, "tells where up is, roughly");
  stage.writes("grid", kind::kGridMap, "map.pgm and map.yaml for map_server and nav2, ground.json");
  stage.tunes("ground", parameters.ground,
              "the ground plane by hand: \"nx ny nz d\" with nx x + ny y + nz z + d = 0 in the world, normal "
              "up; empty: find it");
  stage.tunes("up", parameters.up,
              "upward direction in the world by hand: \"x y z\", within 20 degrees; empty: from the "
              "trajectory, else guessed");
  stage.tunes("ground_tolerance", parameters.search.tolerance_m, "metres a point of the ground may be off it",
              {0.001, 1});
  stage.tunes("min_ground_area", parameters.search.min_area_m2, "square metres of cloud that a ground needs",
              {0.01, 10000});
  stage.tunes("max_below_floor", parameters.search.max_below, "share of the cloud that may lie below a floor",
              {0, 1});
  stage.tunes("resolution", grid.resolution, "side of a cell, metres", {0.001, 100});
  stage.tunes("min_height", grid.min_height, "metres above the ground where obstacles begin", {0, 100});
  stage.tunes("max_height", grid.max_height,
              "metres above the ground where obstacles end (height of the robot)", {0, 1000});
  stage.tunes("min_points", grid.min_points, "points in the band that make a cell occupied", {1, 1000000});
  stage.tunes("margin", grid.margin, "metres of grid around the cloud", {0, 1000});
  stage.tunes(
      "empty_cells", grid.empty_cells,
      "cells without an obstacle: binary = free (the paper), seen = unknown unless the ground was seen there",
      {{"binary", EmptyCells::binary}, {"seen", EmptyCells::seen}});
  return stage.run(argc, argv, [&](Work& work) {
    if (!(grid.min_height < grid.max_height)) throw UsageError("min_height must be below max_height");
    const LabelledCloud cloud = read_cloud(work.in("cloud"));
    const Ground ground = ground_of(work, cloud, parameters);
    GridStatistics statistics;
    GridMap map = project(cloud, ground.plane, grid, statistics);
    map.ground_source = ground.source;
    write_grid_map(work.out(), map);
    work.metrics() = metrics_of(ground, map, statistics);
  });
}
