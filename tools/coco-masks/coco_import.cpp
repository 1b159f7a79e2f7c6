#include "pipeline/artifacts/coco_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/object_mask.hpp"
#include "pipeline/contract/errors.hpp"
#include "tools/coco-masks/coco_conversion.hpp"

namespace sediment::tools {

namespace fs = std::filesystem;

void import_coco(const fs::path& coco_file, const fs::path& masks) {
  if (fs::exists(masks) && !fs::is_empty(masks)) throw contract::UsageError(masks.string() + " is not empty");
  const CocoFile coco = read_coco(coco_file);
  if (coco.images.empty()) throw std::runtime_error(coco_file.string() + ": lists no image");
  const fs::path partial = masks.string() + ".partial";
  fs::remove_all(partial);
  MasksWriter writer(partial);
  for (const CocoImage& image : coco.images) {
    std::vector<ObjectMask> objects;
    for (const CocoObject& object : image.objects)
      if (auto mask = object_of(object.category, object.score, pixels_of(object, image, coco)))
        objects.push_back(std::move(*mask));
    writer.write(image_name(image.file_name), paint(std::move(objects), image.size));
  }
  writer.finish();
  fs::remove(masks);
  fs::rename(partial, masks);
}

}  // namespace sediment::tools
