#pragma once

#include <filesystem>

namespace sediment::tools {

/// Writes a masks artifact as one COCO file: an image STAMP.png per frame in order of time, its instances as
/// run lengths in COCO's text form with class, score, box and area; categories by name from 1. Only visible
/// pixels are in it: where instances overlap, the artifact has given them to one already. Throws
/// std::runtime_error that names the file.
void export_coco(const std::filesystem::path& masks, const std::filesystem::path& coco_file);

/// Writes a COCO file as a masks artifact; a frame's stamp is the name of its image, without folder and
/// extension. Overlaps go to the object with the higher score. `masks` must not exist or be empty; it appears
/// whole or not at all. Throws std::runtime_error that names file, image and annotation.
void import_coco(const std::filesystem::path& coco_file, const std::filesystem::path& masks);

}  // namespace sediment::tools
