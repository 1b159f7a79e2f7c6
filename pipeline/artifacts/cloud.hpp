#pragma once

#include <filesystem>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment {

/// Encoding of a PCD file.
enum class PcdEncoding { ascii, binary, binary_compressed };

/// Writes the `cloud` artifact: cloud.pcd (x y z rgb label instance) and labels.csv (the labels that occur:
/// id, name, r, g, b). Throws std::runtime_error that names the file.
void write_cloud(const std::filesystem::path& folder, const LabelledCloud& cloud, const LabelTable& labels,
                 PcdEncoding encoding);

/// Reads cloud.pcd of a folder. Fields other than x y z may be missing (grey, unlabelled). Throws
/// std::runtime_error that names the file: missing, truncated, no x y z.
LabelledCloud read_cloud(const std::filesystem::path& folder);

/// Reads labels.csv of a folder; empty if there is none.
LabelTable read_cloud_labels(const std::filesystem::path& folder);

/// A single PCD file, for tools.
void write_pcd(const std::filesystem::path& file, const LabelledCloud& cloud, PcdEncoding encoding);
LabelledCloud read_pcd(const std::filesystem::path& file);

}  // namespace sediment
