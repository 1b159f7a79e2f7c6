#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "tools/report/parts.hpp"

namespace sediment::report {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth_px = 480, kQuality = 72, kFeatures = 600;

std::string encoded(const char* extension, const cv::Mat& image, const std::vector<int>& options) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes, options);
  return {bytes.begin(), bytes.end()};
}

/// The position of each instance in the list, from 1, as red; the value of the dynamic mask as green.
cv::Mat overlay(const std::optional<InstanceMask>& mask, const cv::Mat& dynamic, cv::Size size) {
  cv::Mat red(size, CV_8UC1, cv::Scalar(0)), green(size, CV_8UC1, cv::Scalar(0));
  if (mask) {
    cv::Mat ids;
    cv::resize(mask->ids, ids, size, 0, 0, cv::INTER_NEAREST);
    for (std::size_t i = 0; i < mask->instances.size() && i < 255; ++i)
      red.setTo(static_cast<double>(i + 1), ids == mask->instances[i].id);
  }
  if (!dynamic.empty()) cv::resize(dynamic, green, size, 0, 0, cv::INTER_NEAREST);
  cv::Mat image;
  cv::merge(std::vector<cv::Mat>{cv::Mat(size, CV_8UC1, cv::Scalar(0)), green, red}, image);
  return image;
}

/// ORB on what does not move, in pixels of the shown picture.
std::string features_of(const cv::Mat& color, const cv::Mat& dynamic, double scale) {
  cv::Mat grey;
  cv::cvtColor(color, grey, cv::COLOR_BGR2GRAY);
  std::vector<cv::KeyPoint> keypoints;
  const auto orb = cv::ORB::create(kFeatures);
  orb->detect(grey, keypoints, dynamic.empty() ? cv::Mat() : cv::Mat(dynamic == kStatic));
  std::string bytes;
  for (const cv::KeyPoint& keypoint : keypoints)
    for (const float value : {keypoint.pt.x, keypoint.pt.y}) {
      const auto tenths = static_cast<unsigned>(std::lround(value * scale * 10));
      bytes += static_cast<char>(tenths & 255);
      bytes += static_cast<char>(tenths >> 8 & 255);
    }
  return bytes;
}

Json listed(const std::vector<Instance>& instances) {
  Json all = Json::array();
  for (const Instance& instance : instances) {
    Json one = {{"id", instance.id},
                {"class", instance.class_name},
                {"score", std::round(instance.score * 1000) / 1000}};
    if (instance.speed_m_s) one["speed_m_s"] = *instance.speed_m_s;
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

Json frames_part(const Sequence& sequence, const FrameFolders& folders, std::size_t limit, Page& page) {
  std::optional<MasksReader> masks;
  std::optional<DynamicMasksReader> dynamics;
  if (!folders.masks.empty()) masks.emplace(folders.masks);
  if (!folders.dynamic.empty()) dynamics.emplace(folders.dynamic);
  const Camera& camera = sequence.camera();
  const double scale = std::min(1.0, static_cast<double>(kWidth_px) / camera.width);
  const cv::Size size(static_cast<int>(std::lround(camera.width * scale)),
                      static_cast<int>(std::lround(camera.height * scale)));
  Json part = {
      {"of", sequence.size()}, {"width", size.width}, {"height", size.height}, {"frames", Json::array()}};
  const std::size_t count = std::min(limit, sequence.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t idx = count == 1 ? 0 : i * (sequence.size() - 1) / (count - 1);
    const std::string& stamp = sequence.entry(idx).stamp;
    const cv::Mat color = sequence.color(idx);
    std::optional<InstanceMask> mask;
    if (masks && masks->has(stamp)) mask = masks->read(stamp);
    const cv::Mat dynamic = dynamics && dynamics->has(stamp) ? dynamics->read(stamp) : cv::Mat();
    const auto picture = [&] {
      cv::Mat small;
      cv::resize(color, small, size, 0, 0, cv::INTER_AREA);
      return encoded(".jpg", small, {cv::IMWRITE_JPEG_QUALITY, kQuality});
    };
    Json frame = {{"index", idx}, {"stamp", stamp}};
    frame["image"] = page.block("image " + folders.sequence_id + ' ' + stamp, picture);
    if (mask || !dynamic.empty())
      frame["masks"] = page.block("masks " + folders.masks_id + ' ' + folders.dynamic_id + ' ' + stamp, [&] {
        return encoded(".png", overlay(mask, dynamic, size), {cv::IMWRITE_PNG_COMPRESSION, 9});
      });
    frame["features"] = page.block("features " + folders.sequence_id + ' ' + folders.dynamic_id + ' ' + stamp,
                                   [&] { return features_of(color, dynamic, scale); });
    frame["instances"] = listed(mask ? mask->instances : std::vector<Instance>());
    part["frames"].push_back(std::move(frame));
  }
  return part;
}

Json interactions_part(const fs::path& folder) {
  const fs::path file = folder / "interactions.json";
  Json part = {{"classes", Json::array()}, {"rows", Json::array()}};
  try {
    std::ifstream stream(file);
    const Json json = Json::parse(stream);
    std::map<std::string, std::size_t> classes;
    const auto index_of = [&](const std::string& name) {
      const auto [found, is_new] = classes.try_emplace(name, classes.size());
      if (is_new) part["classes"].push_back(name);
      return found->second;
    };
    for (const Json& frame : json.at("frames"))
      for (const Json& one : frame.at("interactions"))
        part["rows"].push_back({frame.at("stamp"), one.at("dynamic_id"), index_of(one.at("dynamic_class")),
                                one.at("static_id"), index_of(one.at("static_class")), one.at("pixel_pairs"),
                                std::round(one.at("mean_depth_difference_m").get<double>() * 1e4) / 1e4,
                                one.at("interacting")});
  } catch (const Json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  return part;
}

}  // namespace sediment::report
