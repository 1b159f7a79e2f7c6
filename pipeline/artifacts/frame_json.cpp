#include "pipeline/artifacts/frame_json.hpp"

#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"

namespace sediment {

void write_frame_json(const std::filesystem::path& file, const char* format,
                      const std::vector<Json>& frames) {
  std::string text = "{\"format\": " + Json(format).dump() + ",\n \"frames\": [";
  const char* separator = "\n  ";
  for (const Json& frame : frames) {
    text += separator + frame.dump();
    separator = ",\n  ";
  }
  write_bytes(file, {text, "\n]}\n"});
}

void read_frame_json(const std::filesystem::path& file, const char* format,
                     const std::function<void(const std::string& stamp, const Json& frame)>& frame) {
  Json json;
  try {
    json = Json::parse(read_bytes(file));
  } catch (const Json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  const Json found = json.is_object() && json.contains("format") ? json["format"] : Json();
  if (found != format)
    throw std::runtime_error(file.string() + ": expected format \"" + format + "\", found " + found.dump());
  if (!json.contains("frames") || !json["frames"].is_array())
    throw std::runtime_error(file.string() + ": the list \"frames\" is missing");
  for (const Json& entry : json["frames"]) {
    std::string stamp;
    try {
      stamp = entry.at("stamp").get<std::string>();
      frame(stamp, entry);
    } catch (const std::exception& error) {
      throw std::runtime_error(file.string() + ": frame \"" + stamp + "\": " + error.what());
    }
  }
}

}  // namespace sediment
