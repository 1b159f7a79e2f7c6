#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/frame.hpp"

namespace sediment::segment {

/// Masks of somebody else, in one of three formats.
class GivenFiles {
 public:
  GivenFiles() = default;
  virtual ~GivenFiles() = default;
  GivenFiles(const GivenFiles&) = delete;
  GivenFiles& operator=(const GivenFiles&) = delete;

  virtual bool has(const SequenceEntry& entry) const = 0;
  /// Throws std::runtime_error that names the file. Safe to call from several threads.
  virtual InstanceMask read(const SequenceEntry& entry) const = 0;
  /// The file that read() reads, for messages.
  virtual std::string name(const SequenceEntry& entry) const = 0;
};

/// Finds out the format of `path`:
/// - a folder with an instances.json in the format of the masks artifact: that,
/// - a COCO file, or a folder with one JSON file that is one,
/// - a folder (or its subfolder masks/) of 8-bit PNG images, 0 = background, 255 = one object of class
/// `given_class`. Images are named after the colour image or its stamp. Throws std::runtime_error that names
/// the path.
std::unique_ptr<GivenFiles> open_given_files(const std::filesystem::path& path,
                                             const std::string& given_class);

}  // namespace sediment::segment
