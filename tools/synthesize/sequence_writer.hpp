#pragma once

#include <filesystem>
#include <functional>

#include "tools/synthesize/recording.hpp"

namespace sediment::synthetic {

/// Writes a recording in TUM's layout with the truth beside it (README.md). `written` is called after each
/// frame, from any thread.
void write_recording(const Recording& recording, const std::filesystem::path& folder,
                     const std::function<void()>& written = {});

}  // namespace sediment::synthetic
