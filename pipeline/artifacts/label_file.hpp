#pragma once

#include <filesystem>

#include "pipeline/scene/labels.hpp"

namespace sediment {

/// Reads a label table in YAML (configs/labels/coco.yaml): a list of {id, name, color: [r, g, b], dynamic:
/// bool}. Throws std::runtime_error with file and line: unknown key, missing name, id or name twice.
LabelTable read_labels(const std::filesystem::path& yaml);

/// configs/labels/coco.yaml as it was when this program was built: what stages use unless told otherwise.
const LabelTable& default_labels();

}  // namespace sediment
