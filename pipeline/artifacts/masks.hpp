#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "pipeline/scene/frame.hpp"

namespace sediment {

/// Writes the `masks` artifact: masks/STAMP.png (16-bit instance ids) and instances.json.
class MasksWriter {
 public:
  explicit MasksWriter(std::filesystem::path folder);
  /// Safe to call from several threads and in any order of frames.
  void write(const std::string& stamp, const InstanceMask& mask);
  /// Writes instances.json (frames in order of their stamps). Must be called once, at the end. `amend` may
  /// change all but the id of an instance: for what is known only when all frames are.
  void finish(const std::function<void(const std::string& stamp, Instance& instance)>& amend = {});

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, std::vector<Instance>> frames_;
};

/// Reads the `masks` artifact. Throws std::runtime_error that names file and frame.
class MasksReader {
 public:
  explicit MasksReader(std::filesystem::path folder);
  bool has(const std::string& stamp) const { return frames_.contains(stamp); }
  /// Every pixel's id is 0 or one of the instances; checked. Safe to call from several threads.
  InstanceMask read(const std::string& stamp) const;
  const std::vector<Instance>& instances(const std::string& stamp) const { return frames_.at(stamp); }
  std::size_t size() const { return frames_.size(); }

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::vector<Instance>> frames_;
};

}  // namespace sediment
