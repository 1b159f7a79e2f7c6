#include "pipeline/artifacts/sequence_file.hpp"

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/yaml_fields.hpp"

namespace sediment {
namespace {

double positive(const YamlFields& fields, const char* key, double value) {
  if (!(value > 0 && value < 1e9)) fields.fail(fields.node(key), std::string(key) + " must be above 0");
  return value;
}

Camera camera_from(const YAML::Node& node, const std::string& file) {
  const YamlFields fields(file, node,
                          {"width", "height", "fx", "fy", "cx", "cy", "distortion", "depth_scale"});
  Camera camera;
  camera.width = fields.require<int>("width");
  camera.height = fields.require<int>("height");
  for (const char* key : {"width", "height"})
    if (fields.require<int>(key) < 1 || fields.require<int>(key) > 65535)
      fields.fail(fields.node(key), std::string(key) + " must be 1 .. 65535");
  camera.fx = positive(fields, "fx", fields.require<double>("fx"));
  camera.fy = positive(fields, "fy", fields.require<double>("fy"));
  camera.cx = fields.require<double>("cx");
  camera.cy = fields.require<double>("cy");
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) fields.fail(node, "cx and cy must be finite");
  camera.depth_scale = positive(fields, "depth_scale", fields.get("depth_scale", camera.depth_scale));
  const auto distortion = fields.get<std::vector<double>>("distortion", {});
  if (!distortion.empty() && distortion.size() != 4 && distortion.size() != 5)
    fields.fail(fields.node("distortion"), "expected [k1, k2, p1, p2] or [k1, k2, p1, p2, k3]");
  for (std::size_t i = 0; i < distortion.size(); ++i) {
    if (!std::isfinite(distortion[i]))
      fields.fail(fields.node("distortion"), "the distortion must be finite");
    camera.distortion[i] = distortion[i];
  }
  return camera;
}

Camera camera_of(const YamlFields& fields, const std::filesystem::path& folder) {
  if (!fields.has("camera")) fields.require<std::string>("camera");
  const YAML::Node node = fields.node("camera");
  return node.IsScalar() ? read_camera(folder / node.as<std::string>()) : camera_from(node, fields.file());
}

/// A file of the sequence that is named, or the default name if that may be left out.
std::optional<std::filesystem::path> existing(const YamlFields& fields, const char* key,
                                              const std::filesystem::path& root) {
  if (!fields.has(key)) return std::nullopt;
  const std::filesystem::path path = root / fields.require<std::string>(key);
  if (!std::filesystem::is_regular_file(path))
    fields.fail(fields.node(key), "there is no file " + path.string());
  return path;
}

void read_window(const YamlFields& sequence, SequenceFile& file) {
  if (!sequence.has("window")) return;
  const YamlFields fields(sequence.file(), sequence.node("window"), {"start", "count", "stride"});
  const auto whole = [&](const char* key, long long least, std::size_t otherwise) {
    const auto value = fields.get<long long>(key, static_cast<long long>(otherwise));
    if (value < least)
      fields.fail(fields.node(key), std::string(key) + " must be at least " + std::to_string(least));
    return static_cast<std::size_t>(value);
  };
  file.start = whole("start", 0, file.start);
  file.count = whole("count", 0, file.count);
  file.stride = whole("stride", 1, file.stride);
}

}  // namespace

Camera read_camera(const std::filesystem::path& yaml) {
  return camera_from(parse_yaml(read_bytes(yaml), yaml.string()), yaml.string());
}

SequenceFile read_sequence_file(const std::filesystem::path& given) {
  const std::filesystem::path yaml = std::filesystem::is_directory(given) ? given / "sequence.yaml" : given;
  const std::filesystem::path folder = yaml.parent_path();
  const YamlFields fields(
      yaml.string(), parse_yaml(read_bytes(yaml), yaml.string()),
      {"root", "color", "depth", "camera", "association", "window", "groundtruth", "accelerometer"});
  SequenceFile file;
  file.root = (folder / fields.get<std::string>("root", ".")).lexically_normal();
  if (!std::filesystem::is_directory(file.root))
    fields.fail(fields.has("root") ? fields.node("root") : YAML::Node(),
                "there is no folder " + file.root.string());
  file.camera = camera_of(fields, folder);
  file.color_list = existing(fields, "color", file.root).value_or(file.root / "rgb.txt");
  file.depth_list = existing(fields, "depth", file.root).value_or(file.root / "depth.txt");
  file.groundtruth = existing(fields, "groundtruth", file.root);
  file.accelerometer = existing(fields, "accelerometer", file.root);
  if (fields.has("association")) {
    const YamlFields association(fields.file(), fields.node("association"), {"tolerance_s"});
    file.tolerance_s = positive(association, "tolerance_s", association.require<double>("tolerance_s"));
  }
  read_window(fields, file);
  return file;
}

}  // namespace sediment
