#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/contract/manifest.hpp"
#include "stages/segment/network/network.hpp"
#include "tests/stages/segment/tiny_network.hpp"
#include "tests/support/needs.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;
using Catch::Matchers::Contains;
using test::TinyNetwork;

namespace {

constexpr int kFrames = 9;

std::string quoted(const std::filesystem::path& path) {
  return " '" + path.string() + "' ";
}

/// Frames of 96 x 64 pixels: in every second one a red block that begins at a cell, nothing in the others.
struct Scene {
  test::TemporaryFolder folder;
  test::TinySequence sequence = test::tiny_sequence(kFrames);

  Scene() {
    sequence.camera.width = 96;
    sequence.camera.height = 64;
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
      Frame& frame = sequence.frames[i];
      frame.color = cv::Mat::zeros(64, 96, CV_8UC3);
      frame.depth = cv::Mat(64, 96, CV_16UC1, cv::Scalar(10000));
      if (i % 2 == 0) frame.color(cv::Rect(static_cast<int>(i % 3) * 32, 0, 32, 32)) = cv::Scalar(0, 0, 255);
    }
    test::write_sequence(folder / "sequence", sequence);
    TinyNetwork network;
    network.names = "{0: 'person', 1: 'plant'}";
    write_onnx(folder / "tiny.onnx", network);
  }

  test::Outcome run(const std::string& more, const std::string& out = "result") const {
    return test::run_program("segment", "--sequence" + quoted(folder / "sequence/sequence.yaml") + "--out" +
                                            quoted(folder / out) + more);
  }
  std::string model(const std::string& name = "tiny.onnx") const { return "--model" + quoted(folder / name); }
  nlohmann::json metrics(const std::string& out = "result") const {
    return nlohmann::json::parse(std::ifstream(folder / out / "metrics.json"));
  }
};

}  // namespace

TEST_CASE("the stage segment writes a mask for every frame and counts what it found") {
  const Scene scene;
  const test::Outcome done = scene.run(scene.model());
  INFO(done.output);
  REQUIRE(done.code == 0);
  CHECK_THAT(done.output, Contains("frames/s"));
  const MasksReader masks(scene.folder / "result");
  REQUIRE(masks.size() == kFrames);
  const InstanceMask found = masks.read(scene.sequence.frames[4].stamp),
                     none = masks.read(scene.sequence.frames[1].stamp);
  REQUIRE(found.instances.size() == 1);
  CHECK(found.instances[0].class_name == "person");
  CHECK(cv::countNonZero(found.ids == 1) > 32 * 32 - 8);  // bilinear masks round off corners
  CHECK(cv::countNonZero(found.ids(cv::Rect(32, 0, 32, 32))) == cv::countNonZero(found.ids));
  CHECK(none.instances.empty());
  CHECK(cv::countNonZero(none.ids) == 0);
  const auto metrics = scene.metrics();
  CHECK(metrics["frames"] == kFrames);
  CHECK(metrics["instances"] == 5);
  CHECK(metrics["instances_per_class"] == nlohmann::json({{"person", 5}}));
  CHECK(metrics["frames_without_person"] == 4);
  CHECK(metrics["frames_without_instances"] == 4);
}

TEST_CASE("one thread and four give equal manifests on every engine") {
  const Scene scene;
  std::vector<std::string> engines = {"opencv"};
  if (!segment::onnxruntime_version().empty()) engines.emplace_back("onnxruntime");
  for (const std::string& engine : engines) {
    INFO(engine);
    REQUIRE(scene.run(scene.model() + "--threads 1 --engine " + engine, "one").code == 0);
    REQUIRE(scene.run(scene.model() + "--threads 4 --engine " + engine, "four").code == 0);
    CHECK(contract::read_manifest(scene.folder / "one").files ==
          contract::read_manifest(scene.folder / "four").files);
  }
}

TEST_CASE("one thread and four give equal manifests with a real network") {
  const auto model = test::needs("models/yolov8n-seg-320.onnx");
  const auto frames = test::needs("tum/rgbd_dataset_freiburg1_rpy_person");
  if (!model || !frames) return;
  const test::TemporaryFolder folder;
  std::ofstream(folder / "sequence.yaml")
      << "root: " << *frames << "\ncamera: " SEDIMENT_SOURCE_DIR "/configs/cameras/freiburg1.yaml\n"
      << "window: {count: 12, stride: 13}\n";
  for (const std::string threads : {"1", "4"}) {
    const test::Outcome done = test::run_program(
        "segment", "--sequence" + quoted(folder / "sequence.yaml") + "--model" + quoted(*model) + "--out" +
                       quoted(folder / threads) + "--threads " + threads);
    INFO(done.output);
    REQUIRE(done.code == 0);
  }
  CHECK(contract::read_manifest(folder / "1").files == contract::read_manifest(folder / "4").files);
  const auto metrics = nlohmann::json::parse(std::ifstream(folder / "1/metrics.json"));
  CHECK(metrics["instances"] > 12);  // not equal because empty
}

TEST_CASE("classes and confidences are chosen by name") {
  const Scene scene;
  REQUIRE(scene.run(scene.model() + "--classes plant").code == 0);
  CHECK(scene.metrics()["instances"] == 0);
  REQUIRE(scene.run(scene.model() + "--class-confidence person=1").code == 0);
  CHECK(scene.metrics()["instances"] == 0);
  REQUIRE(scene.run(scene.model() + "--classes person --confidence 0.9").code == 0);
  CHECK(scene.metrics()["instances"] == 5);
  const test::Outcome refused = scene.run(scene.model() + "--classes persons");
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains("no class \"persons\", did you mean \"person\"?"));
}

TEST_CASE("masks of the stage itself can be given back and stay as they are") {
  const Scene scene;
  REQUIRE(scene.run(scene.model(), "first").code == 0);
  REQUIRE(scene.run("--masks" + quoted(scene.folder / "first"), "second").code == 0);
  CHECK(scene.metrics("second")["engine"] == "given");
  auto first = contract::read_manifest(scene.folder / "first").files;
  auto second = contract::read_manifest(scene.folder / "second").files;
  for (auto* files : {&first, &second})
    std::erase_if(*files, [](const auto& file) { return file.path == "metrics.json"; });
  CHECK(first == second);
}

TEST_CASE("wrong calls and unusable networks are errors that say why") {
  const Scene scene;
  const auto refused = [&](const std::string& arguments, int code, const std::string& message) {
    const test::Outcome outcome = scene.run(arguments);
    CHECK(outcome.code == code);
    CHECK_THAT(outcome.output, Contains(message));
    CHECK_FALSE(std::filesystem::exists(scene.folder / "result"));
  };
  refused("", 2, "give a network with --model or masks with --masks");
  refused("--engine given " + scene.model(), 2, "engine given needs --masks");
  refused("--engine opencv --masks" + quoted(scene.folder.path()), 2, "need --model");
  refused(scene.model() + "--confidence 2", 2, "confidence: expected a number in 0.0 .. 1.0");
  refused(scene.model("missing.onnx"), 2, "missing.onnx does not exist");
  refused("--model" + quoted(scene.folder / "sequence/rgb.txt"), 1, "rgb.txt is no ONNX network");
  TinyNetwork detection;
  detection.segments = false;
  write_onnx(scene.folder / "detection.onnx", detection);
  refused(scene.model("detection.onnx"), 1, "export a -seg network");
  std::filesystem::resize_file(scene.folder / "tiny.onnx", 3000);
  refused(scene.model(), 1, "tiny.onnx is no ONNX network, or truncated");
}

TEST_CASE("grey JPEG files are segmented as well") {
  const auto model = test::needs("models/yolov8n-seg-320.onnx");
  const auto picture = test::needs("rgbd_pairs/person_standing/color0.png");
  if (!model || !picture) return;
  test::TemporaryFolder folder;
  test::TinySequence sequence = test::tiny_sequence(1);
  sequence.camera.width = 640;
  sequence.camera.height = 480;
  sequence.frames[0].color = read_color(*picture);
  sequence.frames[0].depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(10000));
  test::write_sequence(folder / "sequence", sequence);
  cv::Mat grey;
  cv::cvtColor(sequence.frames[0].color, grey, cv::COLOR_BGR2GRAY);
  cv::imwrite((folder / "sequence/grey.jpg").string(), grey);
  std::ofstream(folder / "sequence/rgb.txt") << sequence.frames[0].stamp << " grey.jpg\n";
  const test::Outcome done =
      test::run_program("segment", "--sequence" + quoted(folder / "sequence") + "--model" + quoted(*model) +
                                       "--out" + quoted(folder / "result"));
  INFO(done.output);
  REQUIRE(done.code == 0);
  const MasksReader masks(folder / "result");
  const auto& instances = masks.instances(sequence.frames[0].stamp);
  REQUIRE_FALSE(instances.empty());
  CHECK(instances[0].class_name == "person");
}
