#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "tools/synthesize/recording.hpp"
#include "tools/synthesize/seen_surface.hpp"

namespace sediment::synthetic {

/// Truth that is written only if it is wanted.
struct Extras {
  bool degraded_masks = false;  ///< degraded_instances: what a poor network would detect
  bool clean_depth = false;     ///< depth: exact, to the unit of the file
};

/// Writes the folder `truth`: instances (a `masks` artifact), dynamic (a `dynamic-masks` artifact),
/// static_cloud (a `cloud` artifact).
class TruthWriter {
 public:
  TruthWriter(const Recording& recording, std::filesystem::path folder, const Extras& extras);

  /// Safe to call from several threads and in any order of frames.
  void add(const RecordedFrame& frame);
  /// Must be called once, at the end.
  void finish();

 private:
  const Recording& recording_;
  std::filesystem::path folder_;
  Extras extras_;
  std::vector<bool> missed_;
  MasksWriter instances_;
  DynamicMasksWriter dynamic_;
  std::unique_ptr<MasksWriter> degraded_;
  std::mutex surface_mutex_;
  SeenSurface surface_;
};

}  // namespace sediment::synthetic
