#pragma once

#include <filesystem>
#include <string>

#include "pipeline/runner/store/file_digests.hpp"

namespace sediment::runner {

/// The path a stage is given for a source: for a sequence a folder stands for the sequence.yaml in it.
/// Absolute. Throws contract::UsageError if it does not exist.
std::filesystem::path source_path(const std::string& kind, const std::filesystem::path& given);

/// The content id of a source: the same content has the same id wherever it lies.
///
/// - A file: its digest.
/// - A folder: the id its manifest has or would have (size, digest and path of each file).
/// - A sequence: the digest of its YAML's values, where every text that names an existing file, relative to
/// the YAML
///   file or to `root`, is replaced by the digest of that file and `root` itself is left out; and, of the
///   lists `color` and `depth`, of every image they name. All images of the lists count, whatever the window:
///   the association of colour and depth is the stages' business.
std::string source_id(const std::string& kind, const std::filesystem::path& path, FileDigests& digests);

}  // namespace sediment::runner
