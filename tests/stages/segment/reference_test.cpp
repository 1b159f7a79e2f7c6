// The real networks on real pictures against an independent implementation (DATA.md: models).
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/image_file.hpp"
#include "stages/segment/instance_masks.hpp"
#include "stages/segment/selection.hpp"
#include "tests/support/needs.hpp"

using namespace sediment;
using namespace sediment::segment;
using Json = nlohmann::json;

namespace {

constexpr double kScore = 0.02, kIou = 0.95, kArea = 0.03;

std::vector<ObjectMask> objects_in(const cv::Mat& image, const onnx::Model& model, bool opencv) {
  const onnx::Layout layout = onnx::read_layout(model);
  const Letterbox letterbox = fit(image.size(), {layout.input_size.width, layout.input_size.height});
  const auto network = (opencv ? open_with_opencv : open_with_onnxruntime)(model, layout, letterbox.input);
  const Prediction prediction = network->run(to_input(image, letterbox));
  return assemble(prediction, detect(prediction, select({}, layout.class_names)), letterbox,
                  layout.class_names);
}

Box box_of(const std::array<double, 4>& sides) {
  return {static_cast<float>(sides[0]), static_cast<float>(sides[1]), static_cast<float>(sides[2]),
          static_cast<float>(sides[3])};
}

/// Takes the object that fits out of `objects`; false if there is none.
bool take(const Json& reference, std::vector<ObjectMask>& objects) {
  const Box box = box_of(reference["box_xyxy"].get<std::array<double, 4>>());
  const double area = reference["mask_pixels"];
  for (auto object = objects.begin(); object != objects.end(); ++object) {
    const double found = cv::countNonZero(object->pixels);
    if (object->class_name != reference["class_name"] || overlap(box_of(object->box_px), box) <= kIou)
      continue;
    INFO("score " << object->score << ", area " << found);
    CHECK(std::abs(object->score - reference["score"].get<double>()) <= kScore);
    CHECK(std::abs(found - area) <= kArea * area);
    objects.erase(object);
    return true;
  }
  return false;
}

void check_network(const std::string& name, bool opencv) {
  const auto file = test::needs("models/" + name);
  const auto list = test::needs("models/reference_detections.json");
  if (!file || !list) return;
  const onnx::Model model(*file);
  const Json pictures = Json::parse(std::ifstream(*list))["models"][name];
  REQUIRE(pictures.size() == 12);
  for (const auto& [picture, references] : pictures.items()) {
    const auto image = test::needs(picture);
    if (!image) return;
    std::vector<ObjectMask> objects = objects_in(read_color(*image), model, opencv);
    for (const Json& reference : references) {
      INFO(name << ", " << picture << ": " << reference);
      const bool found = take(reference, objects);
      const bool at_threshold = reference["score"] < 0.25 + kScore;
      CHECK((found || at_threshold));
    }
    for (const ObjectMask& rest : objects) {
      INFO(name << ", " << picture << ": also a " << rest.class_name);
      CHECK(rest.score < 0.25 + kScore);
    }
  }
}

}  // namespace

TEST_CASE("ONNX Runtime finds what an independent implementation finds") {
  if (onnxruntime_version().empty()) {
    WARN("skipped: needs ONNX Runtime");
    return;
  }
  check_network("yolov8n-seg-320.onnx", false);
  check_network("yolov8n-seg-480x640.onnx", false);
  check_network("yolov8n-seg-640.onnx", false);
}

TEST_CASE("OpenCV finds what an independent implementation finds") {
  check_network("yolov8n-seg-320.onnx", true);
  check_network("yolov8n-seg-480x640.onnx", true);
  check_network("yolov8n-seg-640.onnx", true);
}
