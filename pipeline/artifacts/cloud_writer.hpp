#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string_view>

#include "pipeline/artifacts/cloud.hpp"

namespace sediment {

/// Writes a PCD file piece by piece; memory does not grow with it, except for binary_compressed, which is
/// compressed as a whole. Every call throws std::runtime_error that names the file if it cannot be written.
class PcdWriter {
 public:
  PcdWriter(std::filesystem::path file, PcdEncoding encoding);
  void append(std::span<const LabelledPoint> points);
  /// Number of points so far.
  std::uint64_t size() const { return size_; }
  /// Completes the file. Must be called once, at the end.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void put(std::string_view bytes);

  std::filesystem::path file_;
  PcdEncoding encoding_;
  std::unique_ptr<std::FILE, Close> opened_;
  std::uint64_t size_ = 0;
  LabelledCloud whole_;  ///< of binary_compressed
};

/// Writes the `cloud` artifact piece by piece, with the same bytes as write_cloud.
class CloudWriter {
 public:
  CloudWriter(std::filesystem::path folder, PcdEncoding encoding);
  void append(std::span<const LabelledPoint> points);
  std::uint64_t size() const { return pcd_.size(); }
  /// Completes cloud.pcd and writes labels.csv. Must be called once, at the end.
  void finish(const LabelTable& labels);

 private:
  std::filesystem::path folder_;
  PcdWriter pcd_;
  std::set<std::uint32_t> present_;
};

}  // namespace sediment
