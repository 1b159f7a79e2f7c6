#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "tests/tools/evaluate-map/small_room.hpp"
#include "tools/evaluate-map/map_alignment.hpp"
#include "tools/evaluate-map/map_evaluation.hpp"

using namespace sediment;
using namespace sediment::tools;
using sediment::test::SmallRoom;
using sediment::test::operator+;

namespace {

MapEvaluation evaluate(const SmallRoom& room, const LabelledCloud& map, const Pose& truth_from_map = {}) {
  const test::TemporaryFolder folder;
  write_cloud(folder.path(), map, default_labels(), PcdEncoding::binary);
  MapRules rules;
  rules.pixel_step = 1;
  return evaluate_map({room.open(), rules}, folder.path(), truth_from_map);
}

Pose shift(double x, double y, double z) {
  return pose_from({}, {x, y, z});
}

}  // namespace

TEST_CASE("the truth itself is a perfect map") {
  const SmallRoom room;
  const MapEvaluation e = evaluate(room, room.wall());
  CHECK(e.points == room.wall().size());
  CHECK(e.surface->accuracy.mean_m == 0);
  CHECK(e.surface->completion.within == 1);
  CHECK(e.surface->f_score == 1);
  REQUIRE(e.cleaning.size() == 2);
  for (const CleaningScore& score : e.cleaning) {
    CHECK(score.preserved() == 1.0);
    CHECK(score.dynamic > 0);
    CHECK(score.rejected() == 1.0);
    CHECK(score.f1() == 1.0);
  }
  CHECK(e.by_points->static_accuracy == 1);
  CHECK(e.by_points->dynamic_accuracy == 1.0);
  CHECK(e.ghosts->off_surface == 0);
  CHECK(e.labels->mean_iou() == 1.0);
}

TEST_CASE("half a wall, 3 cm too far away, is half complete and 3 cm inaccurate") {
  const SmallRoom room;
  LabelledCloud half;
  for (const LabelledPoint& point : room.wall())
    if (point.x < 0) half.push_back(point);
  const MapEvaluation e = evaluate(room, test::moved(half, shift(0, 0.03, 0)));
  CHECK(e.surface->accuracy.mean_m == Approx(0.03).epsilon(1e-4));
  CHECK(e.surface->accuracy.rmse_m == Approx(0.03).epsilon(1e-4));
  // Beside the half that is there, points up to 4 cm to the side are within 5 cm of the edge.
  CHECK(e.surface->completion.within == Approx((95 + 4) / 190.0));
  CHECK(e.surface->accuracy.within == 1);
  CHECK(e.surface->f_score == Approx(2 * (99 / 190.0) / (1 + 99 / 190.0)));
  CHECK(e.surface->chamfer_m == Approx((e.surface->accuracy.mean_m + e.surface->completion.mean_m) / 2));
  CHECK(evaluate(room, test::moved(half, shift(0, 0.06, 0))).surface->accuracy.within == 0);
}

TEST_CASE("a person left in the map is found by every figure") {
  const SmallRoom room;
  const MapEvaluation e = evaluate(room, room.wall() + room.person());
  for (const CleaningScore& score : e.cleaning) {
    CHECK(score.preserved() == 1.0);
    CHECK(score.rejected() == 0.0);
    CHECK(score.f1() == 0.0);
  }
  CHECK(e.by_points->static_accuracy == 1);
  CHECK(e.by_points->dynamic_accuracy == 0.0);
  CHECK(e.by_points->associated() == 0.0);
  CHECK(e.surface->completion.within == 1);
  const auto people = static_cast<double>(room.person().size());
  CHECK(e.surface->accuracy.within == Approx(1 - people / static_cast<double>(e.points)));
  // The other two frames look through the place where the person stood.
  CHECK(e.ghosts->off_surface == e.cleaning[0].dynamic);
  CHECK(e.ghosts->ghosts == e.ghosts->off_surface);
  CHECK(e.ghosts->largest_cluster == e.ghosts->ghosts);
}

TEST_CASE("a point behind the wall is off the surface, but in no space that was seen to be free") {
  const SmallRoom room;
  LabelledPoint point;
  point.x = 0.01f;
  point.y = 2.5f;
  point.z = 1.01f;
  const MapEvaluation e = evaluate(room, room.wall() + LabelledCloud{point});
  CHECK(e.ghosts->off_surface == 1);
  CHECK(e.ghosts->ghosts == 0);
}

TEST_CASE("a voxel of a mover next to a true surface is not asked to be empty") {
  const SmallRoom room;
  TrueSequence truth = room.open();
  const MoverPoints movers = mover_points(truth, 5, 1);
  CHECK(movers.resting.empty());
  const TrueVoxels before = true_voxels(truth.static_cloud, movers, 0.05);
  CHECK(before.dynamic.size() > 10);
  // A static surface where the person was: nothing is left that must be empty.
  const TrueVoxels after = true_voxels(truth.static_cloud + room.person(), movers, 0.05);
  CHECK(after.dynamic.size() == 0);
}

TEST_CASE("an object that is moved for a while is rightly mapped where it rests") {
  const SmallRoom room;
  // The person becomes a chair that is moved in frame 1 and, in frame 0, rests 10 cm behind that place.
  const cv::Rect place(27, 18, 10, 12);
  const TrueSequence before = room.open();
  cv::Mat depth = before.sequence.depth(0);
  depth(place).setTo(GENERATE(5550, 5050));
  write_png(before.sequence.entry(0).depth, depth);
  MasksWriter instances(room.folder / "truth" / "instances");
  DynamicMasksWriter dynamic(room.folder / "truth" / "dynamic");
  for (std::size_t i = 0; i < 3; ++i) {
    cv::Mat ids(48, 64, CV_16UC1, cv::Scalar(0)), moving(48, 64, CV_8UC1, cv::Scalar(0));
    if (i < 2) ids(place).setTo(4);
    if (i == 1) moving(place).setTo(kNonPriorDynamic);
    instances.write(before.sequence.entry(i).stamp, {ids, {{4, "chair", 1, {}}}});
    dynamic.write(before.sequence.entry(i).stamp, moving, {});
  }
  instances.finish();
  const TrueSequence truth = room.open();
  const MoverPoints movers = mover_points(truth, 5, 1);
  CHECK(movers.dynamic.size() == 120);
  CHECK(movers.resting.size() == 120);
  const TrueVoxels voxels = true_voxels(truth.static_cloud, movers, 0.05);
  const bool moved_away = depth.at<std::uint16_t>(place.y, place.x) == 5550;
  CHECK((voxels.dynamic.size() > 0) == moved_away);
  CHECK(voxels.surface.size() > voxels.still.size());
}

TEST_CASE("labels are compared where the map lies on the truth") {
  const SmallRoom room;
  LabelledCloud map = room.wall();
  for (LabelledPoint& point : map)
    if (point.x > 0) point.label = point.z > 1 ? 56 : kUnlabelled;
  const MapEvaluation e = evaluate(room, map);
  REQUIRE(e.labels->classes.size() == 1);  // no chair is there truly
  CHECK(e.labels->classes.at(62).both == map.size() / 2);
  CHECK(e.labels->classes.at(62).only_truth == map.size() / 2);
  CHECK(e.labels->mean_iou() == 0.5);
  for (LabelledPoint& point : map) point.label = kUnlabelled;
  CHECK_FALSE(evaluate(room, map).labels->mean_iou());
}

TEST_CASE("a map in a world of its own is brought into the truth's by its trajectory") {
  const SmallRoom room;
  Pose map_from_truth = rotation_from({0.5, -1, 2});
  map_from_truth.translation = {10, -20, 3};
  const TrueSequence truth = room.open();
  Trajectory trajectory;
  for (std::size_t i = 0; i < truth.sequence.size(); ++i)
    trajectory.push_back({truth.sequence.entry(i).stamp, truth.sequence.entry(i).stamp_s,
                          map_from_truth * *truth.world_from_camera[i]});
  const Pose found = truth_from_map(truth, trajectory);
  CHECK(norm(found * (map_from_truth * Vec3{1, 2, 3}) - Vec3{1, 2, 3}) < 1e-8);
  const MapEvaluation e = evaluate(room, test::moved(room.wall(), map_from_truth), found);
  CHECK(e.surface->accuracy.mean_m < 1e-5);
  CHECK(e.cleaning[0].preserved() == 1.0);
  for (StampedPose& pose : trajectory) pose.stamp_s += 50;
  CHECK_THROWS(truth_from_map(truth, trajectory));
}

TEST_CASE("points that are not finite are left out and counted") {
  const SmallRoom room;
  LabelledCloud map = room.wall();
  map[0].x = std::numeric_limits<float>::quiet_NaN();
  map[7].z = std::numeric_limits<float>::infinity();
  const MapEvaluation e = evaluate(room, map);
  CHECK(e.not_finite == 2);
  CHECK(e.points == map.size() - 2);
  CHECK_THROWS(evaluate(room, {}));
}
