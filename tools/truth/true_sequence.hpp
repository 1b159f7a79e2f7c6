#pragma once

#include <optional>
#include <vector>

#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/trajectory.hpp"
#include "tools/truth/instance_truth.hpp"
#include "tools/truth/mask_folder.hpp"

namespace sediment::tools {

/// A sequence with everything that is known of it. The world is that of its ground truth.
struct TrueSequence {
  Sequence sequence;
  std::vector<std::optional<Pose>> world_from_camera;  ///< by frame; none where the ground truth has a gap
  LabelledCloud static_cloud;  ///< surfaces that never move and were seen, about 1 cm apart
  MaskFolder dynamic;
  std::optional<InstanceTruth> instances;
};

/// Opens a sequence (YAML or folder) and the truth beside it: `truth/` in its root unless given, with
/// static_cloud/ (a cloud) or static_cloud.ply, dynamic/ and, if there, instances/. Labels of a PLY file are
/// those of the instances.json in the folder ("labels": {"105": "desk", ...}), brought to the default labels
/// by name; names that those do not have become "other furniture". Throws std::runtime_error that names what
/// is missing.
TrueSequence open_true_sequence(const std::filesystem::path& sequence,
                                const std::filesystem::path& truth = {});

/// A cloud from a folder (cloud.pcd), a PCD or a PLY file.
LabelledCloud read_any_cloud(const std::filesystem::path& path);

/// Whether read_any_cloud() would take it.
bool is_cloud(const std::filesystem::path& path);

}  // namespace sediment::tools
