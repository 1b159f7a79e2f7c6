#pragma once

#include <filesystem>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::tools {

/// Reads the vertices of a PLY file, ascii or binary little endian: x y z, and where they are there red green
/// blue (0 .. 255), label and instance; other properties are passed over. Throws std::runtime_error that
/// names the file: missing, truncated, big endian, no x y z, a list among the properties of the vertices.
LabelledCloud read_ply(const std::filesystem::path& file);

}  // namespace sediment::tools
