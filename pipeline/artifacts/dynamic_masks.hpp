#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sediment {

/// Outcome of the interaction test of one pair (paper, section 3.2).
struct Interaction {
  int dynamic_id = 0, static_id = 0;  ///< instances of the frame
  std::string dynamic_class, static_class;
  std::uint64_t pixel_pairs = 0;       ///< N: pairs within the distance, both with depth
  double mean_depth_difference_m = 0;  ///< 0 if there is no pair
  bool interacting = false;
};

/// Writes the `dynamic-masks` artifact: masks/STAMP.png (8 bit, DynamicValue) and interactions.json.
class DynamicMasksWriter {
 public:
  explicit DynamicMasksWriter(std::filesystem::path folder);
  /// Safe to call from several threads and in any order of frames.
  void write(const std::string& stamp, const cv::Mat& mask, std::vector<Interaction> interactions);
  void finish();

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, std::vector<Interaction>> frames_;
};

/// Reads the masks of the `dynamic-masks` artifact; any folder with masks/STAMP.png or STAMP.png of values 0,
/// 1, 2 will do (the json is not needed). Throws std::runtime_error that names file and frame.
class DynamicMasksReader {
 public:
  explicit DynamicMasksReader(std::filesystem::path folder);
  bool has(const std::string& stamp) const;
  /// CV_8UC1 with DynamicValue. Safe to call from several threads.
  cv::Mat read(const std::string& stamp) const;
  /// By stamp; empty if there is no interactions.json.
  std::map<std::string, std::vector<Interaction>> interactions() const;

 private:
  std::filesystem::path folder_, interactions_file_;
};

}  // namespace sediment
