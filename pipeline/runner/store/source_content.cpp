#include "pipeline/runner/store/source_content.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

#include "pipeline/contract/description.hpp"
#include "pipeline/contract/digest.hpp"
#include "pipeline/contract/errors.hpp"
#include "pipeline/contract/manifest.hpp"
#include "pipeline/runner/store/sealed_folder.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;
using contract::UsageError;

/// A sequence's YAML while its paths are replaced by what they point at.
struct SequenceContent {
  fs::path folder, root;
  FileDigests& digests;

  /// Digests of the files that a text names, relative to the root or to the YAML file; the text if there is
  /// none.
  std::string content_of(const std::string& text) const {
    std::string content;
    for (const fs::path& base : {root, folder}) {
      if (text.empty() || !fs::is_regular_file(base / text)) continue;
      const std::string digest = digests.of(base / text).digest;
      if (content != digest) content += digest;
    }
    return content.empty() ? text : content;
  }

  Json value_of(const YAML::Node& node) {
    if (node.IsSequence()) {
      Json list = Json::array();
      for (const auto& item : node) list.push_back(value_of(item));
      return list;
    }
    if (node.IsMap()) {
      Json map = Json::object();
      for (const auto& pair : node) map[pair.first.Scalar()] = value_of(pair.second);
      return map;
    }
    if (!node.IsScalar()) return nullptr;
    return content_of(node.Scalar());
  }
};

std::string text_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The names in the second column of a list, parted as the stages' reader parts it (TUM's own tools take
/// commas and tabs for blanks); '#' begins a comment.
std::vector<std::string> images_in(const fs::path& list) {
  constexpr std::string_view kSeparators = " \t,\r";
  std::vector<std::string> images;
  const std::string text = text_of_file(list);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line(text.data() + at, end - at);
    at = end + 1;
    const std::size_t stamp = std::min(line.find_first_not_of(kSeparators), line.size());
    const std::size_t gap = std::min(line.find_first_of(kSeparators, stamp), line.size());
    const std::size_t name = line.find_first_not_of(kSeparators, gap);
    if (name == line.npos || line[stamp] == '#') continue;
    images.emplace_back(line.substr(name, line.find_first_of(kSeparators, name) - name));
  }
  return images;
}

/// Digest of a list and of all images it names, each given by its name relative to the root.
std::string list_id(const fs::path& root, const std::string& list, FileDigests& digests,
                    const std::map<std::string, std::string>& sealed) {
  const auto is_sealed = [&](const std::string& name) { return sealed.contains(name); };
  std::vector<std::string> names = images_in(root / list);
  names.push_back(list);
  // Paths as text: std::filesystem takes each apart, which costs more than asking the disk.
  const auto path_of = [&](const std::string& name) {
    return name.starts_with('/') ? name : root.native() + '/' + name;
  };
  std::vector<std::string> open;
  for (const std::string& name : names)
    if (!is_sealed(name)) open.push_back(path_of(name));
  digests.add(open);
  std::string text;
  for (std::size_t i = 0, next = 0; i < names.size(); ++i)
    text.append(is_sealed(names[i]) ? sealed.at(names[i]) : digests.at(open[next++]).digest) += '\n';
  return contract::digest_bytes(text);
}

std::string sequence_id(const fs::path& yaml, FileDigests& digests) {
  YAML::Node node;
  try {
    node = YAML::LoadFile(yaml);
  } catch (const YAML::Exception& error) {
    throw UsageError(yaml.string() + ": " + error.what());
  }
  if (!node.IsMap()) throw UsageError(yaml.string() + ": expected a mapping (root, camera, ...)");
  SequenceContent content{yaml.parent_path(), yaml.parent_path(), digests};
  if (node["root"] && node["root"].IsScalar()) content.root = content.folder / node["root"].Scalar();
  node.remove("root");
  std::string text = content.value_of(node).dump();
  auto sealed = SealedFolder::open(content.root, digests.memory());
  for (const auto& [key, usual] : {std::pair("color", "rgb.txt"), std::pair("depth", "depth.txt")}) {
    const std::string list = node[key] ? node[key].Scalar() : usual;
    const auto id = [&](const auto& known) { return list_id(content.root, list, digests, known); };
    text += std::string("\n") + key + ' ' +
            (sealed ? sealed->derived(list, id) : id(std::map<std::string, std::string>()));
  }
  return contract::digest_bytes(text);
}

std::string folder_id(const fs::path& folder, FileDigests& digests) {
  if (const auto sealed = SealedFolder::open(folder, digests.memory())) return sealed->id();
  contract::Manifest manifest;
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::follow_directory_symlink)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (name != contract::kManifestName) files.push_back(name);
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  std::vector<std::string> paths;
  for (const fs::path& file : files) paths.push_back(folder / file);
  digests.add(paths);
  for (std::size_t i = 0; i < files.size(); ++i)
    manifest.files.push_back({files[i].native(), digests.at(paths[i]).bytes, digests.at(paths[i]).digest});
  return manifest.id();
}

}  // namespace

fs::path source_path(const std::string& kind, const fs::path& given) {
  fs::path path = fs::absolute(given).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (!fs::exists(path)) throw UsageError(given.string() + " does not exist");
  if (kind != contract::kind::kSequence || !fs::is_directory(path)) return path;
  if (!fs::exists(path / "sequence.yaml"))
    throw UsageError(given.string() + " is a folder without a sequence.yaml");
  return path / "sequence.yaml";
}

std::string source_id(const std::string& kind, const fs::path& path, FileDigests& digests) {
  if (kind == contract::kind::kSequence) return sequence_id(path, digests);
  if (fs::is_directory(path)) return folder_id(path, digests);
  return digests.of(path).digest;
}

}  // namespace sediment::runner
