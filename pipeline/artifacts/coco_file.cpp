#include "pipeline/artifacts/coco_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"

namespace sediment {
namespace {

using Json = nlohmann::json;

/// Ids are numbers in COCO; some tools write texts.
std::string id_of(const Json& entry, const char* key) {
  return entry.at(key).dump();
}

cv::Size size_of(const Json& height, const Json& width) {
  constexpr int kMost = 1 << 15;
  const cv::Size size(width.get<int>(), height.get<int>());
  if (size.width <= 0 || size.height <= 0 || size.width > kMost || size.height > kMost)
    throw std::runtime_error("an image of " + std::to_string(size.width) + " x " +
                             std::to_string(size.height) + " pixels");
  return size;
}

void read_segmentation(const Json& json, cv::Size image, CocoObject& object) {
  if (json.is_array()) {
    object.polygons = json.get<std::vector<std::vector<double>>>();
    if (object.polygons.empty()) throw std::runtime_error("its segmentation is empty");
    return;
  }
  const cv::Size size = size_of(json.at("size").at(0), json.at("size").at(1));
  if (size != image)
    throw std::runtime_error("its run lengths are of " + std::to_string(size.width) + " x " +
                             std::to_string(size.height) + " pixels, its image of " +
                             std::to_string(image.width) + " x " + std::to_string(image.height));
  const Json& counts = json.at("counts");
  object.run_lengths =
      counts.is_string() ? parse_run_lengths(counts.get_ref<const std::string&>()) : counts.get<RunLengths>();
}

const std::string& look_up(const std::map<std::string, std::string>& names, const std::string& id) {
  const auto found = names.find(id);
  if (found == names.end()) throw std::runtime_error("there is no category with id " + id);
  return found->second;
}

void read_images(const Json& json, CocoFile& coco, std::map<std::string, std::size_t>& by_id) {
  for (const Json& entry : json.at("images")) {
    CocoImage image;
    image.file_name = entry.at("file_name").get<std::string>();
    image.size = size_of(entry.at("height"), entry.at("width"));
    const std::string name = image_name(image.file_name);
    if (!coco.by_name.emplace(name, coco.images.size()).second)
      throw std::runtime_error("two images are called " + name);
    if (!by_id.emplace(id_of(entry, "id"), coco.images.size()).second)
      throw std::runtime_error("two images have the id " + id_of(entry, "id"));
    coco.images.push_back(std::move(image));
  }
}

void read_annotations(const Json& json, CocoFile& coco, const std::map<std::string, std::size_t>& by_id) {
  std::map<std::string, std::string> categories;
  for (const Json& entry : json.at("categories"))
    categories.emplace(id_of(entry, "id"), entry.at("name").get<std::string>());
  std::size_t count = 0;
  for (const Json& entry : json.at("annotations")) {
    CocoObject object;
    object.name = "annotation " + (entry.contains("id") ? id_of(entry, "id") : std::to_string(count));
    ++count;
    try {
      const auto image = by_id.find(id_of(entry, "image_id"));
      if (image == by_id.end())
        throw std::runtime_error("there is no image with id " + id_of(entry, "image_id"));
      object.category = look_up(categories, id_of(entry, "category_id"));
      object.score = entry.value("score", 1.0);
      read_segmentation(entry.at("segmentation"), coco.images[image->second].size, object);
      coco.images[image->second].objects.push_back(std::move(object));
    } catch (const std::exception& error) {
      throw std::runtime_error(object.name + ": " + error.what());
    }
  }
}

}  // namespace

std::string image_name(const std::string& file_name) {
  static constexpr std::array kExtensions = {".png", ".jpg",  ".jpeg", ".bmp",
                                             ".tif", ".tiff", ".webp", ".ppm"};
  const std::filesystem::path path = std::filesystem::path(file_name).filename();
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(kExtensions, extension) != kExtensions.end() ? path.stem().string()
                                                                        : path.string();
}

const CocoImage* CocoFile::find(const std::string& name) const {
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : &images[found->second];
}

CocoFile read_coco(const std::filesystem::path& file) try {
  const Json json = Json::parse(read_bytes(file));
  if (json.is_array())
    throw std::runtime_error(
        "a list of results names no images: `images`, `annotations` and `categories` are needed");
  CocoFile coco;
  coco.file = file;
  std::map<std::string, std::size_t> by_id;
  read_images(json, coco, by_id);
  read_annotations(json, coco, by_id);
  return coco;
} catch (const std::exception& error) {
  throw std::runtime_error(file.string() + " is no COCO file: " + error.what());
}

cv::Mat pixels_of(const CocoObject& object, const CocoImage& image, const CocoFile& coco) try {
  if (object.polygons.empty()) return mask_from(object.run_lengths, image.size);
  cv::Mat mask = cv::Mat::zeros(image.size, CV_8UC1);
  for (const std::vector<double>& polygon : object.polygons) fill_polygon(polygon, mask);
  return mask;
} catch (const std::runtime_error& error) {
  throw std::runtime_error(coco.file.string() + ": " + image.file_name + ": " + object.name + ": " +
                           error.what());
}

}  // namespace sediment
