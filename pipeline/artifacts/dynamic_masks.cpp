#include "pipeline/artifacts/dynamic_masks.hpp"

#include <stdexcept>

#include "pipeline/artifacts/frame_json.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/scene/frame.hpp"

namespace sediment {
namespace {

constexpr const char* kInteractionsFormat = "sediment-dynamic-masks 1";

Json to_json(const Interaction& pair) {
  return {{"dynamic_id", pair.dynamic_id},   {"dynamic_class", pair.dynamic_class},
          {"static_id", pair.static_id},     {"static_class", pair.static_class},
          {"pixel_pairs", pair.pixel_pairs}, {"mean_depth_difference_m", pair.mean_depth_difference_m},
          {"interacting", pair.interacting}};
}

Interaction from_json(const Json& pair) {
  return {pair.at("dynamic_id"),   pair.at("static_id"),   pair.at("dynamic_class"),
          pair.at("static_class"), pair.at("pixel_pairs"), pair.at("mean_depth_difference_m"),
          pair.at("interacting")};
}

void check_values(const cv::Mat& mask, const std::string& name) {
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x)
      if (row[x] > kNonPriorDynamic)
        throw std::runtime_error(name + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is " +
                                 std::to_string(row[x]) +
                                 "; expected 0 (static), 1 (prior dynamic) or 2 (non-prior dynamic)");
  }
}

}  // namespace

DynamicMasksWriter::DynamicMasksWriter(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_ / "masks");
}

void DynamicMasksWriter::write(const std::string& stamp, const cv::Mat& mask,
                               std::vector<Interaction> interactions) {
  if (mask.type() != CV_8UC1) throw std::runtime_error("frame " + stamp + ": a dynamic mask has 8 bits");
  check_values(mask, "frame " + stamp);
  write_png(folder_ / "masks" / (stamp + ".png"), mask);
  const std::lock_guard lock(mutex_);
  if (!frames_.emplace(stamp, std::move(interactions)).second)
    throw std::runtime_error("frame " + stamp + ": its dynamic mask is written twice");
}

void DynamicMasksWriter::finish() {
  std::vector<Json> frames;
  for (const auto& [stamp, interactions] : frames_) {
    Json list = Json::array();
    for (const Interaction& pair : interactions) list.push_back(to_json(pair));
    frames.push_back({{"stamp", stamp}, {"interactions", std::move(list)}});
  }
  write_frame_json(folder_ / "interactions.json", kInteractionsFormat, frames);
}

DynamicMasksReader::DynamicMasksReader(std::filesystem::path folder)
    : folder_(std::move(folder)), interactions_file_(folder_ / "interactions.json") {
  if (std::filesystem::is_directory(folder_ / "masks")) folder_ /= "masks";
  if (!std::filesystem::is_directory(folder_))
    throw std::runtime_error(folder_.string() + ": there is no such folder of dynamic masks");
}

bool DynamicMasksReader::has(const std::string& stamp) const {
  return std::filesystem::exists(folder_ / (stamp + ".png"));
}

cv::Mat DynamicMasksReader::read(const std::string& stamp) const {
  const std::filesystem::path file = folder_ / (stamp + ".png");
  if (!std::filesystem::exists(file))
    throw std::runtime_error(file.string() + ": there is no dynamic mask of frame " + stamp);
  cv::Mat mask = read_gray8(file);
  check_values(mask, file.string());
  return mask;
}

std::map<std::string, std::vector<Interaction>> DynamicMasksReader::interactions() const {
  std::map<std::string, std::vector<Interaction>> frames;
  if (!std::filesystem::exists(interactions_file_)) return frames;
  read_frame_json(interactions_file_, kInteractionsFormat, [&](const std::string& stamp, const Json& frame) {
    for (const Json& pair : frame.at("interactions")) frames[stamp].push_back(from_json(pair));
  });
  return frames;
}

}  // namespace sediment
