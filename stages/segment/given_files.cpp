#include "stages/segment/given_files.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "pipeline/artifacts/coco_file.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/object_mask.hpp"

namespace sediment::segment {
namespace {

namespace fs = std::filesystem;

class ArtifactFiles final : public GivenFiles {
 public:
  explicit ArtifactFiles(const fs::path& folder) : folder_(folder), reader_(folder) {}
  bool has(const SequenceEntry& entry) const override { return reader_.has(entry.stamp); }
  InstanceMask read(const SequenceEntry& entry) const override { return reader_.read(entry.stamp); }
  std::string name(const SequenceEntry& entry) const override {
    return (folder_ / "masks" / (entry.stamp + ".png")).string();
  }

 private:
  fs::path folder_;
  MasksReader reader_;
};

class BinaryImages final : public GivenFiles {
 public:
  BinaryImages(fs::path folder, std::string class_name)
      : folder_(std::move(folder)), class_name_(std::move(class_name)) {}

  bool has(const SequenceEntry& entry) const override { return fs::exists(name(entry)); }
  InstanceMask read(const SequenceEntry& entry) const override {
    const cv::Mat pixels = read_gray8(name(entry));
    for (auto at = pixels.begin<std::uint8_t>(); at != pixels.end<std::uint8_t>(); ++at)
      if (*at != 0 && *at != 255)
        throw std::runtime_error(name(entry) + ": expected pixels of 0 and 255, found " +
                                 std::to_string(*at));
    std::vector<ObjectMask> objects;
    if (auto object = object_of(class_name_, 1, pixels)) objects.push_back(std::move(*object));
    return paint(std::move(objects), pixels.size());
  }
  std::string name(const SequenceEntry& entry) const override {
    const fs::path by_stamp = folder_ / (entry.stamp + ".png");
    const fs::path by_image = folder_ / (image_name(entry.color.string()) + ".png");
    return (fs::exists(by_stamp) ? by_stamp : by_image).string();
  }

 private:
  fs::path folder_;
  std::string class_name_;
};

class CocoMasks final : public GivenFiles {
 public:
  explicit CocoMasks(const fs::path& file) : coco_(read_coco(file)) {}

  bool has(const SequenceEntry& entry) const override { return image(entry) != nullptr; }
  InstanceMask read(const SequenceEntry& entry) const override {
    const CocoImage& of = *image(entry);
    std::vector<ObjectMask> objects;
    for (const CocoObject& each : of.objects)
      if (auto object = object_of(each.category, each.score, pixels_of(each, of, coco_)))
        objects.push_back(std::move(*object));
    return paint(std::move(objects), of.size);
  }
  std::string name(const SequenceEntry&) const override { return coco_.file.string(); }

 private:
  const CocoImage* image(const SequenceEntry& entry) const {
    const CocoImage* by_stamp = coco_.find(entry.stamp);
    return by_stamp != nullptr ? by_stamp : coco_.find(image_name(entry.color.string()));
  }

  CocoFile coco_;
};

std::vector<fs::path> files_with(const fs::path& folder, const char* extension) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == extension) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::unique_ptr<GivenFiles> open_given_files(const fs::path& path, const std::string& given_class) {
  if (!fs::is_directory(path)) return std::make_unique<CocoMasks>(path);
  if (fs::is_directory(path / "masks") && fs::exists(path / "instances.json"))
    return std::make_unique<ArtifactFiles>(path);
  const std::vector<fs::path> lists = files_with(path, ".json");
  if (lists.size() == 1) return std::make_unique<CocoMasks>(lists.front());
  if (lists.size() > 1)
    throw std::runtime_error(path.string() + " has " + std::to_string(lists.size()) +
                             " JSON files: name the COCO file that is meant");
  for (const fs::path& folder : {path, path / "masks"})
    if (fs::is_directory(folder) && !files_with(folder, ".png").empty())
      return std::make_unique<BinaryImages>(folder, given_class);
  throw std::runtime_error(
      path.string() +
      ": there are no masks: expected masks/ with instances.json, PNG images, or a COCO file");
}

}  // namespace sediment::segment
