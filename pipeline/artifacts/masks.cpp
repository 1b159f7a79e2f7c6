#include "pipeline/artifacts/masks.hpp"

#include <stdexcept>

#include "pipeline/artifacts/frame_json.hpp"
#include "pipeline/artifacts/image_file.hpp"

namespace sediment {
namespace {

constexpr const char* kMasksFormat = "sediment-masks 1";

std::filesystem::path image_of(const std::filesystem::path& folder, const std::string& stamp) {
  return folder / "masks" / (stamp + ".png");
}

Json to_json(const Instance& instance) {
  Json json{{"id", instance.id},
            {"class", instance.class_name},
            {"score", instance.score},
            {"box", instance.box_px}};
  if (instance.speed_m_s) json["speed_m_s"] = *instance.speed_m_s;
  return json;
}

Instance instance_from(const Json& json) {
  Instance instance;
  instance.id = json.at("id").get<int>();
  instance.class_name = json.at("class").get<std::string>();
  instance.score = json.value("score", 1.0);
  if (json.contains("box")) instance.box_px = json["box"].get<std::array<double, 4>>();
  if (json.contains("speed_m_s")) instance.speed_m_s = json["speed_m_s"].get<double>();
  return instance;
}

/// Ids must be 1 .. 65535 and ascend, so that a pixel's value names one instance.
void check_ids(const std::vector<Instance>& instances) {
  int previous = 0;
  for (const Instance& instance : instances) {
    if (instance.id <= previous || instance.id > 65535)
      throw std::runtime_error("instance ids must be 1 .. 65535, ascending; found " +
                               std::to_string(instance.id) + " after " + std::to_string(previous));
    previous = instance.id;
  }
}

void check_pixels(const InstanceMask& mask) {
  std::vector<bool> known(65536, false);
  known[0] = true;
  for (const Instance& instance : mask.instances) known[static_cast<std::size_t>(instance.id)] = true;
  for (int y = 0; y < mask.ids.rows; ++y) {
    const auto* row = mask.ids.ptr<std::uint16_t>(y);
    for (int x = 0; x < mask.ids.cols; ++x)
      if (!known[row[x]])
        throw std::runtime_error("pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has id " +
                                 std::to_string(row[x]) + ", which is no instance of the frame");
  }
}

}  // namespace

MasksWriter::MasksWriter(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_ / "masks");
}

void MasksWriter::write(const std::string& stamp, const InstanceMask& mask) {
  try {
    if (mask.ids.type() != CV_16UC1) throw std::runtime_error("instance ids must be an image of 16 bits");
    check_ids(mask.instances);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("frame " + stamp + ": " + error.what());
  }
  write_png(image_of(folder_, stamp), mask.ids);
  const std::lock_guard lock(mutex_);
  if (!frames_.emplace(stamp, mask.instances).second)
    throw std::runtime_error("frame " + stamp + ": its masks are written twice");
}

void MasksWriter::finish(const std::function<void(const std::string&, Instance&)>& amend) {
  std::vector<Json> frames;
  for (auto& [stamp, instances] : frames_) {
    if (amend)
      for (Instance& instance : instances) amend(stamp, instance);
    Json list = Json::array();
    for (const Instance& instance : instances) list.push_back(to_json(instance));
    frames.push_back({{"stamp", stamp}, {"instances", std::move(list)}});
  }
  write_frame_json(folder_ / "instances.json", kMasksFormat, frames);
}

MasksReader::MasksReader(std::filesystem::path folder) : folder_(std::move(folder)) {
  read_frame_json(folder_ / "instances.json", kMasksFormat, [&](const std::string& stamp, const Json& frame) {
    std::vector<Instance> instances;
    for (const Json& instance : frame.at("instances")) instances.push_back(instance_from(instance));
    std::sort(instances.begin(), instances.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    check_ids(instances);
    if (!frames_.emplace(stamp, std::move(instances)).second) throw std::runtime_error("listed twice");
  });
}

InstanceMask MasksReader::read(const std::string& stamp) const {
  const auto found = frames_.find(stamp);
  if (found == frames_.end())
    throw std::runtime_error((folder_ / "instances.json").string() + ": there is no frame " + stamp);
  InstanceMask mask{read_gray16(image_of(folder_, stamp)), found->second};
  try {
    check_pixels(mask);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(image_of(folder_, stamp).string() + ": " + error.what());
  }
  return mask;
}

}  // namespace sediment
