#include "pipeline/runner/store/sealed_folder.hpp"

#include "pipeline/contract/errors.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::kManifestName;
using contract::Manifest;

/// The "stage" in the manifest of a sealed dataset.
constexpr const char* kSealed = "sealed";
constexpr auto kWrite = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;

void check_no_result(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw contract::UsageError(folder.string() + " is no folder");
  if (!fs::exists(folder / kManifestName)) return;
  const std::string stage = contract::read_manifest(folder).stage;
  if (stage != kSealed) throw contract::UsageError(folder.string() + " is a result of the stage " + stage);
}

}  // namespace

Manifest seal_folder(const fs::path& folder) {
  check_no_result(folder);
  Manifest manifest = contract::manifest_of(folder, kSealed);
  for (const auto& file : manifest.files)
    fs::permissions(folder / file.path, kWrite, fs::perm_options::remove);
  contract::write_manifest(manifest, folder);
  return manifest;
}

void unseal_folder(const fs::path& folder) {
  check_no_result(folder);
  if (!fs::exists(folder / kManifestName)) throw contract::UsageError(folder.string() + " is not sealed");
  for (const auto& file : contract::read_manifest(folder).files)
    if (fs::exists(folder / file.path))
      fs::permissions(folder / file.path, fs::perms::owner_write, fs::perm_options::add);
  fs::remove(folder / kManifestName);
}

std::optional<SealedFolder> SealedFolder::open(const fs::path& folder, StatMemory& memory) {
  const fs::path file = folder / kManifestName;
  const auto stat = stat_of(file);
  if (!stat) return std::nullopt;
  std::string id(memory.recall(StatMemory::Use::seal, file.native(), *stat).value_or(""));
  if (id.empty()) {
    const Manifest manifest = contract::read_manifest(folder);
    id = manifest.stage == kSealed ? manifest.id() : "-";
    memory.remember(StatMemory::Use::seal, file.native(), *stat, id, true);
  }
  if (id == "-") return std::nullopt;
  return SealedFolder(folder, *stat, id, memory);
}

std::string SealedFolder::derived(
    const std::string& name,
    const std::function<std::string(const std::map<std::string, std::string>& digests)>& derive) {
  const std::string path = (folder_ / kManifestName).native() + '\n' + name;
  if (const auto known = memory_.recall(StatMemory::Use::seal, path, stat_)) return std::string(*known);
  std::map<std::string, std::string> digests;
  for (const auto& file : contract::read_manifest(folder_).files) digests[file.path] = file.digest;
  std::string value = derive(digests);
  memory_.remember(StatMemory::Use::seal, path, stat_, value, true);
  return value;
}

}  // namespace sediment::runner
