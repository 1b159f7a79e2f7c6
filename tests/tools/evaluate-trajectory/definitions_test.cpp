#include <catch2/catch.hpp>
#include <cmath>

#include "tools/alignment/alignment.hpp"
#include "tools/chart/chart.hpp"
#include "tools/evaluate-trajectory/matching.hpp"
#include "tools/evaluate-trajectory/python_random.hpp"
#include "tools/evaluate-trajectory/statistics.hpp"
#include "tools/evaluate-trajectory/zip_file.hpp"

using namespace sediment;
using namespace sediment::tools;

namespace {

Trajectory at(std::initializer_list<double> stamps_s) {
  Trajectory trajectory;
  for (const double s : stamps_s) trajectory.push_back({std::to_string(s), s, {}});
  return trajectory;
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<Match>& matches) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Match& match : matches) pairs.emplace_back(match.truth_idx, match.estimate_idx);
  return pairs;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

}  // namespace

TEST_CASE("statistics are those of numpy") {
  const Statistics s = statistics_of({4, 1, 3, 2});
  CHECK(s.mean == 2.5);
  CHECK(s.median == 2.5);
  CHECK(s.rmse == Approx(std::sqrt(7.5)));
  CHECK(s.std == Approx(std::sqrt(1.25)));
  CHECK(s.min == 1);
  CHECK(s.max == 4);
  CHECK(s.sse == 30);
  CHECK(statistics_of({3, 9, 5}).median == 5);
  CHECK_THROWS(statistics_of({}));
}

TEST_CASE("TUM matches each pose once, the closest pairs first, below 0.02 s") {
  // The estimate's second pose is nearer to the first true one, which the first pose is nearer still to.
  CHECK(pairs_of(match_as_tum(at({1.0, 1.03}), at({0.999, 1.014}))) == Pairs{{0, 0}, {1, 1}});
  CHECK(pairs_of(match_as_tum(at({1.0}), at({0.99, 1.005}))) == Pairs{{0, 1}});
  CHECK(pairs_of(match_as_tum(at({0}), at({0.02}))).empty());
  CHECK(pairs_of(match_as_tum(at({0}), at({0.0199}))) == Pairs{{0, 0}});
}

TEST_CASE("evo matches the nearest of the longer list up to 0.01 s, more than once if need be") {
  CHECK(pairs_of(match_as_evo(at({0, 1, 2}), at({1.004, 2.011}))) == Pairs{{1, 0}});
  CHECK(pairs_of(match_as_evo(at({0, 5}), at({0.004, 0.006}))) == Pairs{{0, 0}, {0, 1}});
  CHECK(pairs_of(match_as_evo(at({0, 5}), at({0.004, 0.006, 0.25, 5.25}))) == Pairs{{0, 0}});
  CHECK(pairs_of(match_as_evo(at({0, 1}), at({0.5, 0.5078125, 0.53125}))).empty());
}

TEST_CASE("the search of evaluate_rpe.py finds the nearest value") {
  const std::vector<double> values{0, 1, 2, 4, 8, 16};
  CHECK(closest_index(values, -3) == 0);
  CHECK(closest_index(values, 2.9) == 2);
  CHECK(closest_index(values, 3.1) == 3);
  CHECK(closest_index(values, 4) == 3);
  CHECK(closest_index(values, 99) == 5);
}

TEST_CASE("random numbers are those that Python draws after seed(0) and seed(123456)") {
  PythonRandom random(0);
  CHECK(random.uniform() == 0.8444218515250481);
  CHECK(random.uniform() == 0.7579544029403025);
  for (int i = 2; i < 1999; ++i) random.uniform();
  CHECK(random.uniform() == 0.35278860284662805);
  CHECK(PythonRandom(123456).uniform() == 0.8056271362589);
  PythonRandom drawn(0);
  for (const std::size_t expected : {639u, 573u, 318u, 195u, 387u, 306u})
    CHECK(drawn.index_up_to(756) == expected);
}

TEST_CASE("an alignment undoes a rotation, a shift and a scale exactly") {
  const std::vector<Vec3> estimate{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
  Pose moved = rotation_from({0.3, -2, 1});
  moved.translation = {5, -6, 7};
  std::vector<Vec3> truth, scaled_truth;
  for (const Vec3& point : estimate) {
    truth.push_back(moved * point);
    scaled_truth.push_back(moved * (2.5 * point));
  }
  const auto rigid = align(truth, estimate, false), similar = align(scaled_truth, estimate, true);
  REQUIRE(rigid);
  REQUIRE(similar);
  CHECK(rigid->scale == 1);
  CHECK(similar->scale == Approx(2.5).epsilon(1e-12));
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    CHECK(norm(*rigid * estimate[i] - truth[i]) < 1e-12);
    CHECK(norm(*similar * estimate[i] - scaled_truth[i]) < 1e-12);
  }
  const Pose pose = *similar * Pose{};
  CHECK(rotation_angle(pose.inverse() * moved) < 1e-7);
}

TEST_CASE("a mirrored estimate is rotated, never mirrored") {
  const std::vector<Vec3> truth{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  std::vector<Vec3> mirrored;
  for (const Vec3& point : truth) mirrored.push_back({-point.x, point.y, point.z});
  const auto r = align(truth, mirrored, false).value().truth_from_estimate.rotation;
  const double determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
                             r[2] * (r[3] * r[7] - r[4] * r[6]);
  CHECK(determinant == Approx(1));
}

TEST_CASE("an estimate that stands still has no scale") {
  const std::vector<Vec3> truth{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, still(3, Vec3{1, 2, 3});
  CHECK_FALSE(align(truth, still, true));
  CHECK(align(truth, still, false));
}

TEST_CASE("a stored archive has the checksum, sizes and places that ZIP asks for") {
  const std::string zip = zip_of({{"a.txt", "123456789"}, {"b", ""}});
  CHECK(zip.substr(0, 4) == "PK\x03\x04");
  CHECK(zip.substr(14, 4) == "\x26\x39\xf4\xcb");  // the check value of CRC-32
  CHECK(zip.substr(30, 14) == "a.txt123456789");
  const std::size_t directory = 30 + 5 + 9 + 30 + 1;
  CHECK(zip.substr(directory, 4) == "PK\x01\x02");
  CHECK(static_cast<unsigned char>(zip[zip.size() - 6]) == directory);
  CHECK(zip[zip.size() - 12] == 2);
  CHECK(zip.size() == directory + 46 + 5 + 46 + 1 + 22);
}

TEST_CASE("axes are divided into steps of 1, 2 and 5") {
  CHECK(axis_step(10, 10) == Approx(1));
  CHECK(axis_step(0.35, 7) == Approx(0.05));
  CHECK(axis_step(1234, 6) == Approx(200));
}
