#include "tools/evaluate-masks/instance_evaluation.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::tools;

namespace {

InstanceMask mask_of(std::initializer_list<std::pair<Instance, cv::Rect>> instances) {
  InstanceMask mask{cv::Mat(100, 100, CV_16UC1, cv::Scalar(0)), {}};
  for (const auto& [instance, place] : instances) {
    mask.ids(place).setTo(instance.id);
    mask.instances.push_back(instance);
  }
  return mask;
}

Instance named(int id, const char* class_name) {
  return {id, class_name, 1, {}};
}

const cv::Rect kLeft{0, 0, 40, 40}, kRight{50, 0, 40, 40}, kSmall{0, 60, 10, 10};

/// Writes frames "1", "2", ... and evaluates them.
InstanceEvaluation evaluate(const std::vector<InstanceMask>& truth, const std::vector<InstanceMask>& found) {
  const test::TemporaryFolder folder;
  std::vector<std::string> stamps;
  MasksWriter true_writer(folder / "truth"), writer(folder / "found");
  for (std::size_t i = 0; i < truth.size(); ++i) {
    stamps.push_back(std::to_string(i + 1));
    true_writer.write(stamps.back(), truth[i]);
    if (i < found.size()) writer.write(stamps.back(), found[i]);
  }
  true_writer.finish();
  writer.finish();
  return evaluate_instances(InstanceTruth(folder / "truth"), MasksReader(folder / "found"), stamps);
}

}  // namespace

TEST_CASE("instances match by class and overlap") {
  const InstanceMask truth = mask_of({{named(1, "person"), kLeft}, {named(2, "chair"), kRight}});
  // The person is found with half of its pixels; the chair under a wrong name.
  const auto e =
      evaluate({truth}, {mask_of({{named(5, "person"), {0, 0, 20, 40}}, {named(6, "couch"), kRight}})});
  CHECK(e.classes.at("person").matched == 1);
  CHECK(e.classes.at("person").iou_sum == 0.5);
  CHECK(e.classes.at("chair").truth == 1);
  CHECK(e.classes.at("chair").matched == 0);
  CHECK(e.classes.at("couch").found == 1);
  CHECK(e.classes.at("couch").truth == 0);
  CHECK(evaluate({truth}, {mask_of({{named(5, "person"), {0, 0, 19, 40}}})}).classes.at("person").matched ==
        0);
}

TEST_CASE("an identity switches when a true instance is found under another id, gaps included") {
  const InstanceMask truth = mask_of({{named(1, "person"), kLeft}, {named(2, "person"), kRight}});
  const InstanceMask straight = mask_of({{named(1, "person"), kLeft}, {named(2, "person"), kRight}});
  const InstanceMask crossed = mask_of({{named(1, "person"), kRight}, {named(2, "person"), kLeft}});
  CHECK(evaluate({truth, truth, truth}, {straight, straight, straight}).classes.at("person").switches == 0);
  CHECK(evaluate({truth, truth, truth}, {straight, crossed, crossed}).classes.at("person").switches == 2);
  const InstanceMask other = mask_of({{named(9, "person"), kLeft}});
  const auto e = evaluate({truth, truth, truth}, {straight, mask_of({}), other});
  CHECK(e.classes.at("person").switches == 1);
  CHECK(e.classes.at("person").truth == 6);
  CHECK(e.classes.at("person").matched == 3);
}

TEST_CASE("small instances and classes that no network knows are asked of nobody") {
  const InstanceMask truth = mask_of({{named(1, "cup"), kSmall}, {named(2, "wall"), kLeft}});
  const auto e = evaluate({truth}, {mask_of({{named(4, "cup"), kSmall}})});
  CHECK(e.classes.empty());
}

TEST_CASE("frames without masks are left out and counted") {
  const InstanceMask truth = mask_of({{named(1, "person"), kLeft}});
  const auto e = evaluate({truth, truth}, {truth});
  CHECK(e.frames == 1);
  CHECK(e.truth_frames == 2);
  CHECK_THROWS(evaluate({truth}, {}));
}
