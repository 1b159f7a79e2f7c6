#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "pipeline/artifacts/masks.hpp"

namespace sediment::tools {

/// True instances of every frame, whose ids stay the same through the sequence. Two formats are read: the
/// `masks` artifact, and a folder of STAMP.png with an instances.json above it that lists all instances of
/// the sequence once ({"instances": [{"id": 7, "class": "chair"}, ...]}).
class InstanceTruth {
 public:
  /// Throws std::runtime_error that names the file.
  explicit InstanceTruth(const std::filesystem::path& folder);
  /// The one that stands beside `dynamic_masks` (truth/dynamic, truth/instances), if there is one.
  static std::optional<InstanceTruth> beside(const std::filesystem::path& dynamic_masks);

  /// CV_16UC1, 0 = nothing.
  cv::Mat ids(const std::string& stamp) const;
  /// Class of an instance, "" if the id is not known.
  std::string class_of(int id) const;
  const std::map<int, std::string>& classes() const { return classes_; }

 private:
  std::filesystem::path images_;
  std::map<int, std::string> classes_;
};

}  // namespace sediment::tools
