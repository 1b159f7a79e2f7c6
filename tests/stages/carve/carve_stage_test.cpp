#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;

namespace {

int run(const std::string& arguments) {
  return WEXITSTATUS(std::system((SEDIMENT_BINARY_DIR "/carve " + arguments + " 2>/dev/null").c_str()));
}

/// Six frames that look at a wall at 3 m; in the first two somebody stands at 1.5 m. The cloud has the wall
/// and the ghost.
struct Scene {
  test::TemporaryFolder folder;

  Scene() {
    namespace fs = std::filesystem;
    for (const char* name : {"cloud", "track"}) fs::create_directories(folder / name);
    std::ofstream rgb(folder / "rgb.txt"), depth(folder / "depth.txt");
    Trajectory trajectory;
    std::vector<FrameTracking> frames;
    for (int i = 0; i < 6; ++i) {
      const std::string stamp = std::to_string(i) + ".500000";
      cv::Mat image(48, 64, CV_16UC1, cv::Scalar(15000));
      if (i < 2) image.colRange(20, 40).setTo(7500);
      write_png(folder / (stamp + "d.png"), image);
      write_png(folder / (stamp + ".png"), cv::Mat(48, 64, CV_8UC3, cv::Scalar(90, 90, 90)));
      rgb << stamp << ' ' << stamp << ".png\n";
      depth << stamp << ' ' << stamp << "d.png\n";
      trajectory.push_back({stamp, i + 0.5, {}});
      frames.push_back({stamp, TrackingState::tracked, true, 1, 1, 0});
    }
    std::ofstream(folder / "sequence.yaml")
        << "root: .\ncamera: {width: 64, height: 48, fx: 50, fy: 50, cx: 31.5, cy: 23.5}\n";
    write_trajectory(folder / "track", trajectory, frames);
    LabelledCloud cloud;
    for (int x = -15; x <= 15; ++x)
      for (int y = -10; y <= 10; ++y) {
        cloud.push_back({0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), 3, 0, 0, 0, 0, 100, 0});
        if (x > -3 && x < 3)
          cloud.push_back(
              {0.05f * static_cast<float>(x), 0.05f * static_cast<float>(y), 1.5f, 0, 0, 0, 0, 0, 0});
      }
    write_cloud(folder / "cloud", cloud, default_labels(), PcdEncoding::binary);
  }
  std::string call(const std::string& out) const {
    return "--cloud " + (folder / "cloud").string() + " --sequence " + (folder / "sequence.yaml").string() +
           " --trajectory " + (folder / "track").string() + " --out " + (folder / out).string() + " ";
  }
};

}  // namespace

TEST_CASE("the stage carve removes somebody who left, keeps the wall, and writes what it cut") {
  const Scene scene;
  REQUIRE(run(scene.call("out") + "--keep-removed true") == 0);
  const LabelledCloud kept = read_cloud(scene.folder / "out"),
                      removed = read_pcd(scene.folder / "out" / "removed.pcd");
  CHECK(kept.size() == 31 * 21);
  CHECK(std::all_of(kept.begin(), kept.end(), [](const LabelledPoint& p) { return p.label == 100; }));
  CHECK(removed.size() == 5 * 21);
  CHECK(std::all_of(removed.begin(), removed.end(), [](const LabelledPoint& p) { return p.label == 0; }));
  std::ifstream stream(scene.folder / "out" / "metrics.json");
  const auto metrics = nlohmann::json::parse(stream);
  CHECK(metrics.at("views") == 6);
  CHECK(metrics.at("points_removed") == 5 * 21);
}

TEST_CASE("the stage carve leaves what was there for most of the time") {
  const Scene scene;
  REQUIRE(run(scene.call("out") + "--min-share 0.9") == 0);  // four of six frames see through
  CHECK(read_cloud(scene.folder / "out").size() == 31 * 21 + 5 * 21);
}

TEST_CASE("the stage carve writes equal bytes with 1 and with 4 threads") {
  const Scene scene;
  REQUIRE(run(scene.call("one") + "--threads 1") == 0);
  REQUIRE(run(scene.call("four") + "--threads 4") == 0);
  CHECK(contract::read_manifest(scene.folder / "one").id() ==
        contract::read_manifest(scene.folder / "four").id());
}

TEST_CASE("the stage carve takes an empty cloud, fails without poses and refuses wrong calls") {
  const Scene scene;
  CHECK(run(scene.call("out") + "--min-views 0") == 2);
  CHECK(run("--cloud " + (scene.folder / "cloud").string() + " --out " + (scene.folder / "out").string()) ==
        2);
  write_cloud(scene.folder / "cloud", {}, default_labels(), PcdEncoding::binary);
  CHECK(run(scene.call("out")) == 0);
  CHECK(read_cloud(scene.folder / "out").empty());
  write_trajectory(scene.folder / "track", {{"99.5", 99.5, {}}},
                   {{"99.5", TrackingState::tracked, true, 1, 1, 0}});
  CHECK(run(scene.call("other")) == 1);
  CHECK_FALSE(std::filesystem::exists(scene.folder / "other"));
}
