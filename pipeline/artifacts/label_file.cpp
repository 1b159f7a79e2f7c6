#include "pipeline/artifacts/label_file.hpp"

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/yaml_fields.hpp"

namespace sediment {

extern const char* const kEmbeddedLabels;  // configs/labels/coco.yaml, made by CMake

namespace {

Label label_from(const YamlFields& fields) {
  Label label;
  label.id = fields.require<std::uint32_t>("id");
  label.name = fields.require<std::string>("name");
  const auto color = fields.require<std::vector<int>>("color");
  if (color.size() != 3) fields.fail(fields.node("color"), "a color is [red, green, blue]");
  for (int i = 0; i < 3; ++i) {
    if (color[i] < 0 || color[i] > 255) fields.fail(fields.node("color"), "a color value is 0 .. 255");
    label.rgb[i] = static_cast<std::uint8_t>(color[i]);
  }
  label.prior_dynamic = fields.get("dynamic", false);
  return label;
}

LabelTable parse_labels(const std::string& text, const std::string& file) {
  const YAML::Node list = parse_yaml(text, file);
  if (!list.IsSequence()) throw std::runtime_error(file + ": expected a list of labels");
  std::vector<Label> labels;
  LabelTable table;
  for (const YAML::Node& node : list) {
    const YamlFields fields(file, node, {"id", "name", "color", "dynamic"});
    labels.push_back(label_from(fields));
    try {
      table = LabelTable(labels);
    } catch (const std::invalid_argument& error) {
      fields.fail(node, error.what());
    }
  }
  return table;
}

}  // namespace

LabelTable read_labels(const std::filesystem::path& yaml) {
  return parse_labels(read_bytes(yaml), yaml.string());
}

const LabelTable& default_labels() {
  static const LabelTable table = parse_labels(kEmbeddedLabels, "configs/labels/coco.yaml");
  return table;
}

}  // namespace sediment
