#pragma once

#include <filesystem>
#include <functional>

#include "tools/synthesize/truth_writer.hpp"

namespace sediment::synthetic {

/// Writes a recording in TUM's layout with the truth beside it (README.md). `written` is called after each
/// frame, from any thread.
void write_recording(const Recording& recording, const std::filesystem::path& folder,
                     const Extras& extras = {}, const std::function<void()>& written = {});

}  // namespace sediment::synthetic
