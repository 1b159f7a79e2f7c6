#include "pipeline/contract/stage.hpp"
#include "stages/project2d/cost_mask.hpp"
#include "stages/project2d/free_columns.hpp"
#include "stages/project2d/grid_projection.hpp"
#include "stages/project2d/ground_search.hpp"
#include "stages/project2d/map_input.hpp"
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

std::optional<std::filesystem::path> given(const Work& work, const std::string& role) {
  return work.has(role) ? std::optional(work.in(role)) : std::nullopt;
}

MapInput input_of(const Work& work, const GridParameters& grid) {
  if (!work.has("cloud") && !work.has("octree")) throw UsageError("--cloud or --octree is needed");
  if (grid.empty_cells == EmptyCells::rays && !work.has("octree"))
    throw UsageError("empty_cells = rays needs --octree");
  return read_map_input(given(work, "cloud"), given(work, "octree"));
}

std::optional<UpHint> hint_of(const Work& work, const Parameters& parameters) {
  if (!parameters.up.empty()) return parse_up(parameters.up);
  if (!work.has("trajectory")) return std::nullopt;
  return read_up(work.in("trajectory"), given(work, "sequence"));
}

Ground ground_of(const Work& work, const LabelledCloud& cloud, const Parameters& parameters) {
  if (!parameters.ground.empty()) return {parse_plane(parameters.ground), "given", true};
  return find_ground(cloud, hint_of(work, parameters), parameters.search);
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
          {"cells_unknown", statistics.unknown},
          {"cells_speckle", statistics.speckle},
          {"cells_filled", statistics.filled}};
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  GridParameters& grid = parameters.grid;
  Stage stage("project2d", "Finds the ground and projects what stands on it to a navigation grid");
  stage.reads_optional("cloud", kind::kCloud, "cloud to project; without: the octree's occupied cells");
  stage.reads_optional("octree", kind::kOctree, "tells what is free, for empty_cells = rays");
  stage.reads_optional("trajectory", kind::kTrajectory, "tells where up is, roughly");
  stage.reads_optional("sequence", kind::kSequence,
                       "its accelerometer, if it has one, tells where up is; needs the trajectory");
  stage.reads_optional("costs", kind::kFile, "costs of classes (YAML); then a cost mask is written too");
  stage.writes("grid", kind::kGridMap,
               "map.pgm and map.yaml for map_server and nav2, ground.json, costs.pgm");
  stage.tunes("ground", parameters.ground,
              "the ground plane by hand: \"nx ny nz d\" with nx x + ny y + nz z + d = 0 in the world, normal "
              "up; empty: find it");
  stage.tunes("up", parameters.up,
              "upward direction in the world: \"x y z\"; empty: from the trajectory, else guessed");
  stage.tunes("ground_tolerance", parameters.search.tolerance_m, "metres a point of the ground may be off it",
              {0.001, 1});
  stage.tunes("min_ground_area", parameters.search.min_area_m2, "square metres of cloud that a ground needs",
              {0.01, 10000});
  stage.tunes("max_below_floor", parameters.search.max_below, "share of the cloud that may lie below a floor",
              {0, 1});
  stage.tunes("require_floor", parameters.search.require_floor, "fail if a desk is seen, no floor");
  stage.tunes("resolution", grid.resolution, "side of a cell, metres", {0.001, 100});
  stage.tunes("min_height", grid.min_height, "metres above the ground where obstacles begin", {0, 100});
  stage.tunes("max_height", grid.max_height,
              "metres above the ground where obstacles end (height of the robot)", {0, 1000});
  stage.tunes("min_points", grid.min_points, "points in the band that make a cell occupied", {1, 1000000});
  stage.tunes("margin", grid.margin, "metres of grid around the cloud", {0, 1000});
  stage.tunes("empty_cells", grid.empty_cells,
              "cells without an obstacle: binary = free (the paper), seen = unknown unless the ground was "
              "seen there, rays = as seen, or free in the octree",
              {{"binary", EmptyCells::binary}, {"seen", EmptyCells::seen}, {"rays", EmptyCells::rays}});
  stage.tunes("min_free_share", grid.min_free_share,
              "share of the band that rays must have found free, for a cell to be free", {0, 1});
  stage.tunes("free_foot_m", grid.free_foot_m, "or all of the band's lowest metres; 0: none", {0, 100});
  stage.tunes("speckle_points", grid.speckle_points,
              "a lone occupied cell with fewer points becomes unknown; 0: none", {0, 1000000});
  stage.tunes("max_hole_cells", grid.max_hole_cells,
              "at most so many unknown cells amid free ones become free; 0: none", {0, 1000000});
  stage.tunes("close_notches", grid.close_notches, "unknown cells in gaps of one or two become free");
  return stage.run(argc, argv, [&](Work& work) {
    if (!(grid.min_height < grid.max_height)) throw UsageError("min_height must be below max_height");
    const MapInput input = input_of(work, grid);
    const Ground ground = ground_of(work, input.cloud, parameters);
    GridStatistics statistics;
    GridMap map = project(input.cloud, ground.plane, grid, statistics, free_by_rays(input.tree.get(), grid));
    map.ground_source = ground.source;
    write_grid_map(work.out(), map);
    if (work.has("costs"))
      write_cost_mask(work.out(), map,
                      cost_mask(map, input.cloud, input.labels, read_class_costs(work.in("costs")),
                                grid.max_height, grid.min_points));
    work.metrics() = metrics_of(ground, map, statistics);
  });
}
