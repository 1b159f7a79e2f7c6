#include <fmt/format.h>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/look.hpp"
#include "pipeline/runner/execution/text_table.hpp"
#include "pipeline/runner/store/pruning.hpp"
#include "pipeline/runner/store/sealed_folder.hpp"
#include "pipeline/runner/store/verification.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::UsageError;

/// The keys that pipelines would use now, as far as they are known.
std::set<std::string> keys_of(const Arguments& arguments) {
  std::set<std::string> keys;
  for (const std::string& config : arguments.keep) {
    Arguments other = arguments;
    other.config = config;
    for (const LookedAt& one : look(other).stages)
      if (one.task.key) keys.insert(one.task.key->id);
  }
  return keys;
}

}  // namespace

int verify_store(const Arguments& arguments) {
  const Store store(store_of(arguments));
  const Verification found = verify(store, arguments.share);
  for (const std::string& damage : found.damages) fmt::print("{}\n", damage);
  const std::string verdict =
      found.damages.empty()
          ? "all well"
          : fmt::format("{} damaged and put aside; a run makes them again", found.damages.size());
  fmt::print("{} receipts and {} results ({}) checked in {}: {}\n", found.receipts, found.objects,
             shown_bytes(found.bytes), store.root().string(), verdict);
  return found.damages.empty() ? contract::kDone : contract::kFailed;
}

int prune_store(const Arguments& arguments) {
  PruningRules rules;
  if (!arguments.older_than.empty()) rules.older_than_s = seconds_from(arguments.older_than);
  if (!arguments.max_size.empty()) rules.max_bytes = amount_from("memory", arguments.max_size);
  if (!arguments.keep.empty()) rules.keep = keys_of(arguments);
  if (!rules.older_than_s && !rules.max_bytes && !rules.keep)
    throw UsageError("prune what? say --older-than AGE, --max-size SIZE or --keep CONFIG");
  rules.dry_run = arguments.dry_run;
  Store store(store_of(arguments));
  std::vector<std::vector<std::string>> rows{{"stage", "made", "freed", "key"}};
  std::uint64_t bytes = 0;
  for (const Pruned& one : prune(store, rules)) {
    rows.push_back({one.stage, one.made, shown_bytes(one.bytes), one.key});
    bytes += one.bytes;
  }
  if (rows.size() > 1) fmt::print("{}", aligned(rows, {2}));
  fmt::print("{} results {} removed, {}\n", rows.size() - 1, rules.dry_run ? "would be" : "were",
             shown_bytes(bytes));
  return contract::kDone;
}

int pin(const Arguments& arguments) {
  const Look all = look(arguments);
  for (const LookedAt* one : all.named(arguments.stage)) {
    if (!one->task.hit) throw UsageError(one->label + " has no result now: run it first");
    set_pinned(*all.opened.store, one->task.key->id, !arguments.remove);
    fmt::print("{}: {}\n", one->label, arguments.remove ? "no longer pinned" : "pinned");
  }
  return contract::kDone;
}

int seal(const Arguments& arguments) {
  const fs::path& folder = arguments.config;
  if (arguments.remove) {
    unseal_folder(folder);
    fmt::print("{} is no longer sealed\n", folder.string());
    return contract::kDone;
  }
  const contract::Manifest manifest = seal_folder(folder);
  fmt::print("{} files, {} sealed in {}; they are read-only now (sealed again, a change counts)\n",
             manifest.files.size(), shown_bytes(manifest.bytes()),
             (folder / contract::kManifestName).string());
  return contract::kDone;
}

}  // namespace sediment::runner
