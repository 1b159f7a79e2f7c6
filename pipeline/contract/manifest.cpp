#include "pipeline/contract/manifest.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/contract/digest.hpp"

namespace sediment::contract {
namespace {

namespace fs = std::filesystem;
constexpr const char* kManifestFormat = "sediment-manifest 1";

}  // namespace

std::string Manifest::id() const {
  std::string lines;
  for (const FileEntry& file : files)
    lines += std::to_string(file.bytes) + ' ' + file.digest + ' ' + file.path + '\n';
  return digest_bytes(lines);
}

std::uint64_t Manifest::bytes() const {
  std::uint64_t sum = 0;
  for (const FileEntry& file : files) sum += file.bytes;
  return sum;
}

Manifest manifest_of(const fs::path& folder, const std::string& stage) {
  Manifest manifest{stage, {}};
  const auto follow = fs::directory_options::follow_directory_symlink;
  for (const auto& entry : fs::recursive_directory_iterator(folder, follow)) {
    if (!entry.is_regular_file()) continue;
    const std::string path = entry.path().lexically_relative(folder).generic_string();
    if (path != kManifestName) manifest.files.push_back({path, entry.file_size(), ""});
  }
  std::sort(manifest.files.begin(), manifest.files.end(),
            [](const FileEntry& a, const FileEntry& b) { return a.path < b.path; });
  tbb::parallel_for(std::size_t{0}, manifest.files.size(), [&](std::size_t i) {
    manifest.files[i].digest = digest_file(folder / manifest.files[i].path);
  });
  return manifest;
}

void write_manifest(const Manifest& manifest, const fs::path& folder) {
  nlohmann::ordered_json json;
  json["format"] = kManifestFormat;
  json["stage"] = manifest.stage;
  json["id"] = manifest.id();
  json["bytes"] = manifest.bytes();
  json["files"] = nlohmann::ordered_json::array();
  for (const FileEntry& file : manifest.files)
    json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"digest", file.digest}});
  std::ofstream stream(folder / kManifestName, std::ios::binary);
  stream << json.dump(1) << '\n';
  stream.close();
  if (!stream)
    throw std::runtime_error("cannot write " + (folder / kManifestName).string() + ": " +
                             std::strerror(errno));
}

Manifest read_manifest(const fs::path& folder) {
  const fs::path file = folder / kManifestName;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string() + ": " + std::strerror(errno));
  try {
    const auto json = nlohmann::json::parse(stream);
    if (json.at("format") != kManifestFormat)
      throw std::runtime_error("expected format \"" + std::string(kManifestFormat) + "\", found " +
                               json.at("format").dump());
    Manifest manifest{json.at("stage"), {}};
    for (const auto& entry : json.at("files"))
      manifest.files.push_back({entry.at("path"), entry.at("bytes"), entry.at("digest")});
    if (json.at("id") != manifest.id()) throw std::runtime_error("its id does not match its entries");
    return manifest;
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + " is no manifest: " + error.what());
  }
}

}  // namespace sediment::contract
