// The interaction test on the masks of the rendered twins, against the direct double loop over the pixels
// near each instance's outline. One core, one run, printed as Markdown. Arguments: folders of twins; default:
// those of the real data.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "benchmarks/timing.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "stages/interaction-mask/contact.hpp"
#include "tests/support/needs.hpp"

using namespace sediment;
using benchmark::seconds_of;
using namespace sediment::interaction_mask;
namespace fs = std::filesystem;

namespace {

constexpr double kRadius_px = 6;
constexpr std::size_t kDirectEvery =
    30;  ///< the direct loop takes so long that it gets every n-th frame only

struct TestFrame {
  cv::Mat ids, depth;
  std::vector<int> dynamic_ids, static_ids;
};

std::vector<TestFrame> frames_of(const fs::path& twin) {
  const auto truth = nlohmann::json::parse(std::ifstream(twin / "truth/instances.json"));
  std::map<int, std::string> class_of;
  for (const auto& instance : truth["instances"]) class_of[instance["id"]] = instance["class"];
  std::vector<TestFrame> frames;
  std::ifstream list(twin / "associations.txt");
  for (std::string stamp, color, depth_stamp, depth; list >> stamp >> color >> depth_stamp >> depth;) {
    TestFrame frame{
        read_gray16(twin / "truth/instances" / (stamp + ".png")), read_gray16(twin / depth), {}, {}};
    std::vector<char> seen(65536);
    for (const std::uint16_t id : cv::Mat_<std::uint16_t>(frame.ids)) seen[id] = 1;
    for (const auto& [id, name] : class_of)
      if (seen[id]) (name == "person" ? frame.dynamic_ids : frame.static_ids).push_back(id);
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// Pixels of an instance within the radius of a pixel that is not its own: only these can take part in a
/// pair.
std::vector<cv::Point> near_outline(const cv::Mat& ids, int id) {
  cv::Mat inside, distance;
  cv::copyMakeBorder(ids == id, inside, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::distanceTransform(inside, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<cv::Point> pixels;
  for (int y = 0; y < ids.rows; ++y)
    for (int x = 0; x < ids.cols; ++x)
      if (const float d = distance.at<float>(y + 1, x + 1); d > 0 && d <= kRadius_px)
        pixels.emplace_back(x, y);
  return pixels;
}

std::vector<ContactSum> direct_double_loop(const TestFrame& frame) {
  std::vector<std::vector<cv::Point>> dynamic, fixed;
  for (const int id : frame.dynamic_ids) dynamic.push_back(near_outline(frame.ids, id));
  for (const int id : frame.static_ids) fixed.push_back(near_outline(frame.ids, id));
  std::vector<ContactSum> sums;
  for (const auto& side_a : dynamic)
    for (const auto& side_b : fixed) {
      ContactSum& sum = sums.emplace_back();
      for (const cv::Point a : side_a)
        for (const cv::Point b : side_b) {
          if ((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) > kRadius_px * kRadius_px) continue;
          const int depth_a = frame.depth.at<std::uint16_t>(a), depth_b = frame.depth.at<std::uint16_t>(b);
          if (depth_a == 0 || depth_b == 0) continue;
          ++sum.pixel_pairs;
          sum.depth_difference += static_cast<std::uint64_t>(std::abs(depth_a - depth_b));
        }
    }
  return sums;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void measure(const fs::path& twin) {
  const std::vector<TestFrame> frames = frames_of(twin);
  std::vector<double> ours_ms, direct_ms, ratios;
  std::size_t pairs = 0, different = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TestFrame& frame = frames[i];
    std::vector<ContactSum> sums;
    const auto run = [&] {
      sums = contact_sums(frame.ids, frame.depth, frame.dynamic_ids, frame.static_ids, kRadius_px);
    };
    run();  // warms the caches, as decoding the images does in the stage
    ours_ms.push_back(1e3 * seconds_of(run));
    pairs += sums.size();
    if (i % kDirectEvery != 0) continue;
    std::vector<ContactSum> direct;
    direct_ms.push_back(1e3 * seconds_of([&] { direct = direct_double_loop(frame); }));
    ratios.push_back(direct_ms.back() / ours_ms.back());
    different += direct != sums;
  }
  std::printf("| %s | %zu | %.1f | %.3f | %.3f | %.1f | %.0f | %zu |\n", twin.filename().c_str(),
              frames.size(), static_cast<double>(pairs) / frames.size(), median(ours_ms),
              *std::max_element(ours_ms.begin(), ours_ms.end()), median(direct_ms), median(ratios),
              different);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fs::path> twins(argv + 1, argv + argc);
  if (twins.empty())
    for (const char* name : {"twins/twin_walking_xyz", "twins/twin_sitting_static"})
      if (const auto twin = test::needs(name)) twins.push_back(*twin);
  std::puts(
      "| masks | frames | pairs a frame | ours, median [ms] | ours, worst [ms] | direct, median [ms] | ratio "
      "| "
      "frames that differ |\n|---|---|---|---|---|---|---|---|");
  for (const fs::path& twin : twins) measure(twin);
}
