#pragma once

#include <cstdint>
#include <filesystem>
#include <set>

#include "pipeline/scene/labels.hpp"

namespace sediment {

/// Writes the labels whose ids are `present` as lines of id,name,r,g,b below a header line. An id that the
/// table does not know has no line.
void write_label_csv(const std::filesystem::path& file, const LabelTable& labels,
                     const std::set<std::uint32_t>& present);

/// Reads it; an empty table if there is no such file. Throws std::runtime_error with file and line.
LabelTable read_label_csv(const std::filesystem::path& file);

}  // namespace sediment
