#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "pipeline/artifacts/coco_rle.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "tools/coco-masks/coco_conversion.hpp"
#include "tools/truth/mask_folder.hpp"

namespace sediment::tools {
namespace {

using Json = nlohmann::json;

/// Classes in alphabetical order, numbered from 1: the same for the same classes.
std::map<std::string, int> number_classes(const MasksReader& masks, const std::vector<std::string>& stamps) {
  std::map<std::string, int> ids;
  for (const std::string& stamp : stamps)
    for (const Instance& instance : masks.instances(stamp)) ids.emplace(instance.class_name, 0);
  int next = 1;
  for (auto& [name, id] : ids) id = next++;
  return ids;
}

Json annotation_of(const Instance& instance, const cv::Mat& pixels, std::size_t image_id, int category_id) {
  const cv::Rect box = cv::boundingRect(pixels);
  return {{"image_id", image_id},
          {"category_id", category_id},
          {"score", instance.score},
          {"iscrowd", 0},
          {"area", cv::countNonZero(pixels)},
          {"bbox", {box.x, box.y, box.width, box.height}},
          {"segmentation",
           {{"size", {pixels.rows, pixels.cols}}, {"counts", format_run_lengths(run_lengths_of(pixels))}}}};
}

/// A list with one entry a line.
struct JsonList {
  std::string text;
  void add(const Json& entry) { text += (text.empty() ? "\n  " : ",\n  ") + entry.dump(); }
};

}  // namespace

void export_coco(const std::filesystem::path& masks, const std::filesystem::path& coco_file) {
  const MasksReader reader(masks);
  const std::vector<std::string> stamps = MaskFolder(masks).stamps();
  for (const std::string& stamp : stamps)
    if (!reader.has(stamp))
      throw std::runtime_error(masks.string() + ": instances.json has no frame " + stamp);
  const std::map<std::string, int> categories = number_classes(reader, stamps);
  JsonList images, annotations, classes;
  std::size_t annotation_id = 0;
  for (std::size_t image_id = 1; image_id <= stamps.size(); ++image_id) {
    const std::string& stamp = stamps[image_id - 1];
    const InstanceMask mask = reader.read(stamp);
    images.add({{"id", image_id},
                {"file_name", stamp + ".png"},
                {"width", mask.ids.cols},
                {"height", mask.ids.rows}});
    for (const Instance& instance : mask.instances) {
      Json annotation =
          annotation_of(instance, mask.ids == instance.id, image_id, categories.at(instance.class_name));
      annotation["id"] = ++annotation_id;
      annotations.add(annotation);
    }
  }
  for (const auto& [name, id] : categories) classes.add({{"id", id}, {"name", name}});
  write_bytes(coco_file, {"{\"images\": [", images.text, "],\n \"annotations\": [", annotations.text,
                          "],\n \"categories\": [", classes.text, "]}\n"});
}

}  // namespace sediment::tools
