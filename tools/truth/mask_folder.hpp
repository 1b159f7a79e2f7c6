#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifacts/masks.hpp"

namespace sediment::tools {

/// Masks of frames, whoever made them: STAMP.png in a folder or in its subfolder masks/.
class MaskFolder {
 public:
  /// Throws std::runtime_error that names the folder if there is none or it holds no PNG.
  explicit MaskFolder(const std::filesystem::path& folder);

  /// In order of time. Throws (in the constructor) if a file's name is no stamp.
  const std::vector<std::string>& stamps() const { return stamps_; }
  bool has(const std::string& stamp) const { return std::filesystem::exists(file_of(stamp)); }
  std::filesystem::path file_of(const std::string& stamp) const { return images_ / (stamp + ".png"); }
  /// Whether the images are instance ids of 16 bits with an instances.json (the `masks` artifact).
  bool has_instances() const { return instances_.has_value(); }

  /// What is dynamic, CV_8UC1: the image itself (not 0 = dynamic); of instances those whose class is prior
  /// dynamic by the default labels, as 1. Safe to call from several threads.
  cv::Mat dynamic(const std::string& stamp) const;

 private:
  std::filesystem::path images_;
  std::vector<std::string> stamps_;
  std::optional<MasksReader> instances_;
};

}  // namespace sediment::tools
