#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sediment {

using Json = nlohmann::json;

/// Writes {"format": FORMAT, "frames": [...]} with one frame a line. Every frame has the key "stamp".
void write_frame_json(const std::filesystem::path& file, const char* format, const std::vector<Json>& frames);

/// Reads it and calls `frame` for every frame. Throws std::runtime_error that names the file, and the frame
/// for what `frame` throws: missing, not JSON, another format or version.
void read_frame_json(const std::filesystem::path& file, const char* format,
                     const std::function<void(const std::string& stamp, const Json& frame)>& frame);

}  // namespace sediment
