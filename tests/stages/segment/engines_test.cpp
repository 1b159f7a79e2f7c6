#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "stages/segment/instance_masks.hpp"
#include "stages/segment/selection.hpp"
#include "tests/stages/segment/tiny_network.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::segment;
using test::TinyNetwork;

namespace {

const cv::Scalar kRed(0, 0, 255), kGreen(0, 255, 0);

using Open = decltype(&open_with_opencv);

std::vector<std::pair<std::string, Open>> engines() {
  std::vector<std::pair<std::string, Open>> all = {{"opencv", open_with_opencv}};
  if (!onnxruntime_version().empty()) all.emplace_back("onnxruntime", open_with_onnxruntime);
  return all;
}

std::vector<ObjectMask> run(const TinyNetwork& network, Open open, const cv::Mat& image,
                            const Parameters& parameters = {}) {
  const sediment::test::TemporaryFolder folder;
  write_onnx(folder / "tiny.onnx", network);
  const onnx::Model model(folder / "tiny.onnx");
  const onnx::Layout layout = onnx::read_layout(model);
  const Letterbox letterbox = fit(image.size(), network.input);
  const auto opened = open(model, layout, network.input);
  const Prediction prediction = opened->run(to_input(image, letterbox));
  return assemble(prediction, detect(prediction, select(parameters, layout.class_names)), letterbox,
                  layout.class_names);
}

cv::Mat whole(const ObjectMask& object, cv::Size image) {
  cv::Mat mask = cv::Mat::zeros(image, CV_8UC1);
  object.pixels.copyTo(mask(object.window));
  return mask;
}

/// What TinyNetwork's prototypes say of red in an input, enlarged by OpenCV: 255 where it is more probable
/// than not.
cv::Mat colored_in(cv::Size input, const std::vector<cv::Rect>& areas, int pixels_per_input_pixel = 1) {
  cv::Mat color = cv::Mat::zeros(input, CV_32F), prototypes, enlarged;
  for (const cv::Rect& area : areas) color(area) = 1;
  cv::resize(color, prototypes, input / 4, 0, 0, cv::INTER_AREA);
  for (float& share : cv::Mat_<float>(prototypes)) share = 1 / (1 + std::exp(10 - 20 * share));
  cv::resize(prototypes, enlarged, input * pixels_per_input_pixel, 0, 0, cv::INTER_LINEAR);
  return enlarged > 0.5;
}

cv::Mat cropped(const cv::Mat& mask, const cv::Rect& box) {
  cv::Mat inside = cv::Mat::zeros(mask.size(), CV_8UC1);
  mask(box).copyTo(inside(box));
  return inside;
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a != b) == 0;
}

}  // namespace

TEST_CASE("every layout of an export gives the exact class, score, box and mask on every engine") {
  for (const auto& [engine, open] : engines())
    for (const bool split : {false, true})
      for (const bool swapped : {false, true})
        for (const bool dynamic : {false, true}) {
          INFO(engine << ", split " << split << ", swapped " << swapped << ", dynamic " << dynamic);
          TinyNetwork network;
          network.split = split;
          network.swapped = swapped;
          network.dynamic = dynamic;
          cv::Mat image = cv::Mat::zeros(64, 96, CV_8UC3);
          const cv::Rect red(32, 0, 44, 36), green(0, 32, 32, 32);
          image(red) = kRed;
          image(green) = kGreen;
          const std::vector<ObjectMask> objects = run(network, open, image);
          REQUIRE(objects.size() == 2);
          CHECK(objects[0].class_name == "red thing");
          CHECK(objects[1].class_name == "it's green");
          CHECK(objects[0].score == Approx(1 / (1 + std::exp(-10.0))));
          const cv::Rect box = test::box_at({32, 0}, image.size());
          CHECK(objects[0].box_px[0] == Approx(box.x).margin(1e-3));
          CHECK(objects[0].box_px[1] == Approx(box.y).margin(1e-3));
          CHECK(objects[0].box_px[2] == Approx(box.br().x).margin(1e-3));
          CHECK(objects[0].box_px[3] == Approx(box.br().y).margin(1e-3));
          CHECK(
              equal(whole(objects[0], image.size()), cropped(colored_in(network.input, {red, green}), box)));
        }
}

TEST_CASE("masks are interpolated to an image of another size, letterbox borders left out") {
  for (const auto& [engine, open] : engines()) {
    INFO(engine);
    // 128 x 128 in 96 x 64: scaled by a half to 64 x 64, 16 pixels of border left and right.
    cv::Mat image = cv::Mat::zeros(128, 128, CV_8UC3);
    const cv::Rect red(32, 64, 80, 64);  // in the input: 32, 32, 40, 32
    image(red) = kRed;
    const std::vector<ObjectMask> objects = run({}, open, image);
    REQUIRE(objects.size() == 1);
    const cv::Mat expected = colored_in({96, 64}, {{32, 32, 40, 32}}, 2)(cv::Rect(32, 0, 128, 128));
    CHECK(cv::countNonZero(expected) > 80 * 64 - 20);
    CHECK(equal(whole(objects[0], image.size()), expected));
    CHECK(objects[0].box_px[0] == Approx(32).margin(1e-3));
    CHECK(objects[0].box_px[2] == Approx(128).margin(1e-3));
  }
}

TEST_CASE("an image without objects gives none, and one full of them gives all") {
  for (const auto& [engine, open] : engines()) {
    INFO(engine);
    TinyNetwork network;
    network.input = {320, 320};
    CHECK(run(network, open, cv::Mat::zeros(320, 320, CV_8UC3)).empty());
    // Boxes reach into the next cell but overlap by less than 0.7: each of the 100 cells keeps its object.
    const cv::Mat red(320, 320, CV_8UC3, kRed);
    CHECK(run(network, open, red).size() == 100);
    Parameters few;
    few.max_detections = 7;
    CHECK(run(network, open, red, few).size() == 7);
  }
}

TEST_CASE("both engines give the same detections for the same picture of noise") {
  if (engines().size() < 2) {
    WARN("skipped: needs ONNX Runtime");
    return;
  }
  cv::Mat small(20, 20, CV_8UC3), image(640, 640, CV_8UC3);
  cv::RNG random(7);
  random.fill(small, cv::RNG::UNIFORM, 0, 256);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) image.at<cv::Vec3b>(y, x) = small.at<cv::Vec3b>(y / 32, x / 32);
  for (const bool attention : {false, true}) {
    INFO("attention " << attention);
    TinyNetwork network;
    network.input = image.size();
    network.attention = attention;
    const auto a = run(network, open_with_opencv, image), b = run(network, open_with_onnxruntime, image);
    REQUIRE(a.size() == b.size());
    REQUIRE(a.size() > 2);
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(a[i].class_name == b[i].class_name);
      CHECK(a[i].score == Approx(b[i].score));
      CHECK(equal(whole(a[i], image.size()), whole(b[i], image.size())));
    }
  }
}
