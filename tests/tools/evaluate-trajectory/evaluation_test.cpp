#include "tools/evaluate-trajectory/evaluation.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <numbers>
#include <random>

#include "tests/support/needs.hpp"

using namespace sediment;
using namespace sediment::tools;
using Catch::Matchers::Contains;

namespace {

Trajectory some_path(int poses, double interval_s = 0.1) {
  Trajectory path;
  for (int i = 0; i < poses; ++i) {
    const double t = interval_s * i;
    Pose pose = rotation_from({0.4 * std::sin(t), 0.3 * t, 0.2 * std::cos(2 * t)});
    pose.translation = {std::sin(t), 0.5 * std::cos(1.3 * t), 0.2 * t};
    path.push_back({std::to_string(t), t, pose});
  }
  return path;
}

Trajectory shaken(const Trajectory& path, double size) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, size);
  Trajectory result = path;
  for (StampedPose& pose : result) {
    Pose error = rotation_from({noise(random), noise(random), noise(random)});
    error.translation = {noise(random), noise(random), noise(random)};
    pose.world_from_camera = pose.world_from_camera * error;
  }
  return result;
}

Trajectory moved(const Trajectory& path, const Pose& by) {
  Trajectory result = path;
  for (StampedPose& pose : result) pose.world_from_camera = by * pose.world_from_camera;
  return result;
}

Pose some_move() {
  Pose move = rotation_from({1, 2, -0.5});
  move.translation = {3, -4, 5};
  return move;
}

Eigen::Matrix4d matrix_of(const Pose& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) m(row, column) = pose.rotation[row * 3 + column];
  m.topRightCorner<3, 1>() << pose.translation.x, pose.translation.y, pose.translation.z;
  return m;
}

double angle_deg(const Eigen::Matrix4d& m) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(m.topLeftCorner<3, 3>())).angle() * 180 / std::numbers::pi;
}

/// Kabsch's rotation, written here once more.
Eigen::Matrix4d aligned_by_hand(const Trajectory& truth, const Trajectory& estimate) {
  Eigen::Vector3d truth_mean = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero();
  const auto n = static_cast<double>(truth.size());
  const auto position = [](const StampedPose& p) {
    return Eigen::Vector3d(matrix_of(p.world_from_camera).block<3, 1>(0, 3));
  };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth_mean += position(truth[i]) / n;
    mean += position(estimate[i]) / n;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < truth.size(); ++i)
    covariance += (position(estimate[i]) - mean) * (position(truth[i]) - truth_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation =
      svd.matrixV() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixU().transpose();
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() = rotation;
  result.topRightCorner<3, 1>() = truth_mean - rotation * mean;
  return result;
}

/// "name value unit" lines as TUM's tools print them.
std::map<std::string, double> reference_values(const std::filesystem::path& file) {
  std::map<std::string, double> values;
  std::ifstream stream(file);
  for (std::string name, value, unit; stream >> name >> value;) {
    if (name.find('.') == std::string::npos && name != "compared_pose_pairs") {
      stream.clear();
      std::getline(stream, unit);
      continue;
    }
    values[name] = std::stod(value);
    std::getline(stream, unit);
  }
  return values;
}

}  // namespace

TEST_CASE("a moved copy of the truth has no error, but for evo's without alignment") {
  const Trajectory truth = some_path(60);
  const Evaluation e = evaluate({truth, 0}, moved(truth, some_move()), FrameCount{80, "test"});
  CHECK(e.ate.matches.size() == 60);
  CHECK(e.ate.statistics.max < 1e-12);
  REQUIRE(e.rpe.size() == 3);
  for (const RelativeErrors& rpe : e.rpe) {
    CHECK(rpe.translation_m.max < 1e-12);
    CHECK(rpe.rotation_deg.max < 1e-5);
  }
  CHECK(e.coverage() == 0.75);
  CHECK(statistics_of(e.ape_aligned.translation_m).max < 1e-12);
  CHECK(statistics_of(e.ape_aligned.rotation_deg).max < 1e-10);
  CHECK(statistics_of(e.ape.rotation_deg).min ==
        Approx(rotation_angle(some_move()) * 180 / std::numbers::pi));
  CHECK(statistics_of(e.evo_rpe.full).max < 1e-12);
  CHECK(e.ape_scaled->alignment->scale == Approx(1));
}

TEST_CASE("an error of one pose shows in the absolute error there and in the two motions around it") {
  const Trajectory truth = some_path(41);
  Trajectory estimate = truth;
  estimate[20].world_from_camera.translation.z += 0.1;
  const Evaluation e = evaluate({truth, 0}, estimate, std::nullopt);
  CHECK_FALSE(e.coverage());
  CHECK(std::max_element(e.ate.error_m.begin(), e.ate.error_m.end()) - e.ate.error_m.begin() == 20);
  CHECK(e.evo_rpe.translation_m[18] < 1e-12);
  CHECK(e.evo_rpe.translation_m[19] == Approx(0.1));
  CHECK(e.evo_rpe.translation_m[20] == Approx(0.1));
  CHECK(e.evo_rpe.translation_m[21] < 1e-12);
  // With a delta of 1 s = 10 poses: from 10 to 20 and from 20 to 30. Pairs that end at the last pose are
  // dropped.
  const RelativeErrors& second = e.rpe.at(0);
  CHECK(second.errors.size() == 30);
  for (const RelativeError& error : second.errors) {
    CHECK(error.to_idx == error.from_idx + 10);
    const bool touched = error.from_idx == 20 || error.to_idx == 20;
    CHECK(error.translation_m == Approx(touched ? 0.1 : 0).margin(1e-12));
  }
  CHECK(e.rpe.at(1).errors.size() == 39);
  CHECK(e.rpe.at(2).errors.size() == 41 * 41);
}

TEST_CASE("evo's definitions agree with an independent calculation to 1e-9") {
  const Trajectory truth = some_path(200);
  const Trajectory estimate = moved(shaken(truth, 0.02), some_move());
  const Evaluation e = evaluate({truth, 0}, estimate, std::nullopt);
  REQUIRE(e.evo_matches.size() == 200);
  const Eigen::Matrix4d alignment = aligned_by_hand(truth, estimate);
  for (std::size_t i = 0; i < 200; ++i) {
    const Eigen::Matrix4d q = matrix_of(truth[i].world_from_camera),
                          p = matrix_of(estimate[i].world_from_camera);
    const Eigen::Matrix4d plain = q.inverse() * p, aligned = q.inverse() * alignment * p;
    const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
    REQUIRE(std::abs(e.ape.translation_m[i] - (p - q).block<3, 1>(0, 3).norm()) < 1e-9);
    REQUIRE(std::abs(e.ape.rotation_deg[i] - angle_deg(plain)) < 1e-9);
    REQUIRE(std::abs(e.ape.full[i] - (plain - identity).norm()) < 1e-9);
    REQUIRE(std::abs(e.ape_aligned.translation_m[i] - aligned.block<3, 1>(0, 3).norm()) < 1e-9);
    REQUIRE(std::abs(e.ape_aligned.rotation_deg[i] - angle_deg(aligned)) < 1e-9);
    REQUIRE(std::abs(e.ape_aligned.full[i] - (aligned - identity).norm()) < 1e-9);
    if (i == 0) continue;
    const Eigen::Matrix4d q0 = matrix_of(truth[i - 1].world_from_camera),
                          p0 = matrix_of(estimate[i - 1].world_from_camera);
    const Eigen::Matrix4d error = (q0.inverse() * q).inverse() * (p0.inverse() * p);
    REQUIRE(std::abs(e.evo_rpe.translation_m[i - 1] - error.block<3, 1>(0, 3).norm()) < 1e-9);
    REQUIRE(std::abs(e.evo_rpe.rotation_deg[i - 1] - angle_deg(error)) < 1e-9);
    REQUIRE(std::abs(e.evo_rpe.full[i - 1] - (error - identity).norm()) < 1e-9);
  }
}

TEST_CASE("the scale of an estimate is found, and its errors vanish with it") {
  const Trajectory truth = some_path(50);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate)
    pose.world_from_camera.translation = 0.5 * pose.world_from_camera.translation;
  const Evaluation e = evaluate({truth, 0}, estimate, std::nullopt);
  REQUIRE(e.ape_scaled);
  CHECK(e.ape_scaled->alignment->scale == Approx(2).epsilon(1e-12));
  CHECK(statistics_of(e.ape_scaled->full).max < 1e-10);
  CHECK(statistics_of(e.evo_rpe_scaled->full).max < 1e-10);
  CHECK(e.ate.statistics.rmse > 0.1);
}

TEST_CASE("TUM's tools printed the same six digits for DynaSLAM's trajectories") {
  const std::string name =
      GENERATE("walking_xyz", "walking_static", "walking_halfsphere", "walking_rpy", "sitting_static");
  const auto folder = test::needs("tum/trajectories/freiburg3_" + name);
  if (!folder) return;
  const Evaluation e = evaluate(read_ground_truth(*folder / "groundtruth.txt"),
                                read_tum_trajectory(*folder / "dynaslam_estimate.txt"), std::nullopt);
  const auto ate = reference_values(*folder / "dynaslam_ate_reference.txt");
  const auto rpe = reference_values(*folder / "dynaslam_rpe_reference.txt");
  const auto check = [&](const auto& reference, const std::string& prefix, const Statistics& s,
                         double median_factor) {
    CHECK(std::abs(reference.at(prefix + ".rmse") - s.rmse) < 0.51e-6);
    CHECK(std::abs(reference.at(prefix + ".mean") - s.mean) < 0.51e-6);
    CHECK(std::abs(reference.at(prefix + ".median") - s.median * median_factor) < 0.51e-6);
    CHECK(std::abs(reference.at(prefix + ".std") - s.std) < 0.51e-6);
    CHECK(std::abs(reference.at(prefix + ".min") - s.min) < 0.51e-6);
    CHECK(std::abs(reference.at(prefix + ".max") - s.max) < 0.51e-6);
  };
  INFO(name);
  CHECK(ate.at("compared_pose_pairs") == static_cast<double>(e.ate.matches.size()));
  check(ate, "absolute_translational_error", e.ate.statistics, 1);
  CHECK(rpe.at("compared_pose_pairs") == static_cast<double>(e.rpe.at(0).errors.size()));
  check(rpe, "translational_error", e.rpe.at(0).translation_m, 1);
  // The version that printed the references leaves this one figure in radians.
  check(rpe, "rotational_error", e.rpe.at(0).rotation_deg, std::numbers::pi / 180);
}

TEST_CASE("where a number would mean nothing there is an error instead") {
  const Trajectory truth = some_path(30);
  Trajectory later = truth, pair(truth.begin(), truth.begin() + 2);
  for (StampedPose& pose : later) pose.stamp_s += 1000;
  CHECK_THROWS_WITH(evaluate({truth, 0}, later, std::nullopt),
                    Contains("0 poses of the estimate") && Contains("same sequence?"));
  CHECK_THROWS_WITH(evaluate({truth, 0}, pair, std::nullopt),
                    Contains("2 poses") && Contains("at least 3 are needed"));
  CHECK_THROWS_WITH(evaluate({truth, 0}, {}, std::nullopt), Contains("the estimate holds no pose"));
  CHECK_THROWS_WITH(evaluate({{}, 0}, truth, std::nullopt), Contains("the truth holds no pose"));
  CHECK_THROWS_WITH(evaluate({truth, 0}, truth, FrameCount{29, "rgb.txt"}),
                    Contains("30 poses, but there are only 29 frames"));
}

TEST_CASE("a trajectory shorter than a second has no error per second") {
  const Evaluation e = evaluate({some_path(9), 0}, some_path(9), std::nullopt);
  for (const RelativeErrors& rpe : e.rpe) CHECK(rpe.pairs_rule != "1 s");
}
