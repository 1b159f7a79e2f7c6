#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifacts/coco_rle.hpp"

namespace sediment {

/// An annotation of a COCO file.
struct CocoObject {
  std::string name;  ///< "annotation 7", for messages
  std::string category;
  double score = 1;
  std::vector<std::vector<double>> polygons;  ///< their union, or:
  RunLengths run_lengths;
};

/// An image of a COCO file.
struct CocoImage {
  std::string file_name;
  cv::Size size;
  std::vector<CocoObject> objects;  ///< in the order of the file, crowds too
};

/// Masks in COCO's JSON format (`images`, `annotations`, `categories`; the segmentation as polygons, as run
/// lengths or as their text), as annotation tools export it.
struct CocoFile {
  std::filesystem::path file;
  std::vector<CocoImage> images;

  /// The image whose file name is `name`, folder and extension left out; nullptr if there is none.
  const CocoImage* find(const std::string& name) const;

  std::map<std::string, std::size_t, std::less<>> by_name;  ///< index of the image
};

/// Throws std::runtime_error that names the file and the annotation: not JSON, not COCO, two images of one
/// name, an annotation of an image or a category that is not there.
CocoFile read_coco(const std::filesystem::path& file);

/// CV_8UC1 of the image's size, 255 = object. Throws std::runtime_error that names file, image and
/// annotation.
cv::Mat pixels_of(const CocoObject& object, const CocoImage& image, const CocoFile& coco);

/// "color/12.500.png" -> "12.500": only the extensions of images are taken off.
std::string image_name(const std::string& file_name);

}  // namespace sediment
