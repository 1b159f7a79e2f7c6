#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/scene/frame.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;

namespace {

int run(const std::string& arguments) {
  return WEXITSTATUS(std::system((SEDIMENT_BINARY_DIR "/render " + arguments + " >/dev/null 2>&1").c_str()));
}

/// Pixels within `margin` of a colour.
int count(const cv::Mat& picture, cv::Vec3b bgr, int margin) {
  cv::Mat near;
  cv::inRange(picture, cv::Scalar(bgr) - cv::Scalar::all(margin), cv::Scalar(bgr) + cv::Scalar::all(margin),
              near);
  return cv::countNonZero(near);
}

/// A green square metre at z = 0 with a red one above it at z = 1, shifted by 0.5 m.
LabelledCloud two_squares() {
  LabelledCloud cloud;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y) {
      LabelledPoint p;
      p.x = 0.01f * static_cast<float>(x), p.y = 0.01f * static_cast<float>(y);
      p.g = 200;
      cloud.push_back(p);
      p.x += 0.5f, p.z = 1, p.g = 0, p.r = 200, p.label = 56;
      cloud.push_back(p);
    }
  return cloud;
}

}  // namespace

TEST_CASE("a cloud from above shows what lies on top, by image, by class and by height") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "cloud");
  write_cloud(folder / "cloud", two_squares(), default_labels(), PcdEncoding::binary);
  const std::string call = "cloud " + (folder / "cloud").string() +
                           " --view top --up '0 0 1' --shading 0 --size 300x200 --out " +
                           (folder / "a.png").string();
  REQUIRE(run(call) == 0);
  const cv::Mat picture = read_color(folder / "a.png");
  CHECK(picture.size() == cv::Size(300, 200));
  const int red = count(picture, {0, 0, 200}, 2), green = count(picture, {0, 200, 0}, 2);
  CHECK(red == Approx(184 * 184).epsilon(0.03));    // 184 pixels a metre fill the height but for the border
  CHECK((green > 0.4 * red && green < 0.5 * red));  // half of it is hidden; the scale bar covers a little

  REQUIRE(run(call + " --color label") == 0);
  const Label* chair = default_labels().find("chair");
  REQUIRE(chair != nullptr);
  CHECK(count(read_color(folder / "a.png"), {chair->rgb[2], chair->rgb[1], chair->rgb[0]}, 70) > 0.5 * red);
  REQUIRE(run(call + " --color height --max-height 0.5") == 0);
  CHECK(run("cloud " + (folder / "cloud" / "cloud.pcd").string() + " --out " + (folder / "b.png").string()) ==
        0);
}

TEST_CASE("an octree, a grid and a trajectory become pictures") {
  const test::TemporaryFolder folder;
  octomap::ColorOcTree tree(0.1);
  for (int i = 0; i < 10; ++i) {
    tree.updateNode(octomap::point3d(0.1f * static_cast<float>(i) + 0.05f, 0.05f, 0.05f), true);
    tree.setNodeColor(0.1f * static_cast<float>(i) + 0.05f, 0.05f, 0.05f, 255, 0, 0);
  }
  tree.updateInnerOccupancy();
  write_octree(folder.path(), tree, {}, default_labels());
  REQUIRE(run("octree " + folder.path().string() + " --up '0 0 1' --view top --size 320x240 --out " +
              (folder / "o.png").string()) == 0);
  CHECK(count(read_color(folder / "o.png"), {0, 0, 255}, 60) > 1000);

  GridMap map;
  map.width = 20, map.height = 10;
  map.cells.assign(200, Cell::free);
  map.at(0, 0) = Cell::occupied;
  write_grid_map(folder.path(), map);
  REQUIRE(run("grid " + folder.path().string() + " --pixels 400 --out " + (folder / "g.png").string()) == 0);
  const cv::Mat grid = read_color(folder / "g.png");
  CHECK(count(grid.rowRange(0, grid.rows - 104), {54, 40, 32}, 0) >=
        380);  // one cell of 20 x 20 pixels, in the lower left corner
  CHECK(count(grid(cv::Rect(12, 12 + 180, 20, 20)), {54, 40, 32}, 0) >= 380);

  Trajectory truth;
  for (int i = 0; i < 50; ++i)
    truth.push_back({std::to_string(i),
                     static_cast<double>(i),
                     {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.1 * i, 0.002 * i * i, 0}}});
  write_tum_trajectory(folder / "truth.txt", truth);
  for (auto& pose : truth) pose.world_from_camera = rotation_from({0, 0, 1}) * pose.world_from_camera;
  write_tum_trajectory(folder / "estimate.txt", truth);
  const std::string estimate = (folder / "estimate.txt").string(),
                    out = " --out " + (folder / "t.png").string();
  CHECK(run("trajectory " + estimate + out) == 0);
  CHECK(run("trajectory " + estimate + " --truth " + (folder / "truth.txt").string() + out) == 0);
}

TEST_CASE("masks are drawn over their frames") {
  const test::TemporaryFolder folder;
  const cv::Mat image(48, 64, CV_8UC3, cv::Scalar(90, 90, 90)), depth(48, 64, CV_16UC1, cv::Scalar(5000));
  write_png(folder / "0.png", image);
  write_png(folder / "d.png", depth);
  std::ofstream(folder / "rgb.txt") << "0.5 0.png\n";
  std::ofstream(folder / "depth.txt") << "0.5 d.png\n";
  std::ofstream(folder / "sequence.yaml")
      << "root: .\ncamera: {width: 64, height: 48, fx: 50, fy: 50, cx: 32, cy: 24}\n";
  DynamicMasksWriter writer(folder.path());
  cv::Mat mask = cv::Mat::zeros(48, 64, CV_8UC1);
  mask.colRange(0, 32).setTo(kPriorDynamic);
  writer.write("0.5", mask, {});
  writer.finish();
  const std::string call = "masks --sequence " + (folder / "sequence.yaml").string() + " --dynamic " +
                           folder.path().string() + " --out " + (folder / "m.png").string();
  REQUIRE(run(call) == 0);
  const cv::Mat picture = read_color(folder / "m.png");
  const cv::Mat left = picture(cv::Rect(8, 52, 270, 400)), right = picture(cv::Rect(300, 52, 260, 400));
  CHECK(count(left, {60, 60, 235}, 10) > 270 * 400 / 5);
  CHECK(count(right, {60, 60, 235}, 10) == 0);
  CHECK(run(call + " --frames 0.5") == 0);
  CHECK(run(call + " --frames 1") == 1);
}

TEST_CASE("wrong calls end with 2, work that fails with 1, help with 0") {
  CHECK(run("--help") == 0);
  CHECK(run("cloud --help") == 0);
  CHECK(run("") == 2);
  CHECK(run("statue x --out y.png") == 2);
  CHECK(run("cloud /nowhere --out y.png") == 2);
  const test::TemporaryFolder folder;
  std::ofstream(folder / "cloud.pcd") << "nonsense";
  const std::string pcd =
      "cloud " + (folder / "cloud.pcd").string() + " --out " + (folder / "y.png").string();
  CHECK(run(pcd) == 1);
  CHECK(run(pcd + " --size 10") == 2);
  CHECK(run(pcd + " --view pose") == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "y.png"));
}

TEST_CASE("an empty cloud is an empty sheet") {
  const test::TemporaryFolder folder;
  write_cloud(folder.path(), {}, default_labels(), PcdEncoding::binary);
  CHECK(run("cloud " + folder.path().string() + " --out " + (folder / "y.png").string()) == 0);
}

TEST_CASE("a picture is what its file's extension says") {
  const test::TemporaryFolder folder;
  write_cloud(folder.path(), {}, default_labels(), PcdEncoding::binary);
  const std::string call = "cloud " + folder.path().string() + " --size 320x240 --out ";
  REQUIRE(run(call + (folder / "y.jpg").string()) == 0);
  REQUIRE(run(call + (folder / "y.png").string()) == 0);
  std::string jpeg(3, ' '), png(4, ' ');
  std::ifstream(folder / "y.jpg", std::ios::binary).read(jpeg.data(), 3);
  std::ifstream(folder / "y.png", std::ios::binary).read(png.data(), 4);
  CHECK(jpeg == "\xff\xd8\xff");
  CHECK(png == "\x89PNG");
  CHECK(run(call + (folder / "y.bmp").string()) == 1);
  CHECK(run(call + (folder / "none" / "y.png").string()) == 1);
}
