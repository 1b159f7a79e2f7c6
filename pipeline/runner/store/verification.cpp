#include "pipeline/runner/store/verification.hpp"

#include <algorithm>
#include <iterator>
#include <random>

#include "pipeline/contract/progress.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

/// What is wrong with a result; empty if nothing is.
std::string damage_of_object(const fs::path& object, std::uint64_t& bytes) try {
  const auto claimed = contract::read_manifest(object);
  const auto found = contract::manifest_of(object, claimed.stage);
  bytes += found.bytes();
  if (found.files != claimed.files) return "its files do not match its manifest";
  if (object_name(claimed.id()) != object.parent_path().filename() / object.filename())
    return "it is not the content its name says";
  return "";
} catch (const std::exception& error) {
  return error.what();
}

std::string damage_of_receipt(const fs::path& file, const Store& store) {
  const auto receipt = store.receipt_in(file);
  if (!receipt) return "it is cut or changed";
  return fs::exists(store.object_path(receipt->object)) ? "" : "its result is gone";
}

}  // namespace

Verification verify(const Store& store, double share) {
  Verification all;
  const auto note = [&](const char* what, const fs::path& path, const std::string& damage) {
    if (damage.empty()) return;
    all.damages.push_back(std::string(what) + ' ' + path.string() + ": " + damage);
    store.put_aside(path);
  };
  std::vector<fs::path> objects = store.object_folders(), sample;
  std::mt19937 random{std::random_device{}()};
  std::sample(objects.begin(), objects.end(), std::back_inserter(sample),
              static_cast<std::size_t>(share * static_cast<double>(objects.size()) + 0.999999), random);
  {
    contract::Progress progress("verify", sample.size(), "results");
    for (const fs::path& object : sample) {
      note("result", object, damage_of_object(object, all.bytes));
      ++all.objects;
      progress.advance();
    }
  }
  for (const fs::path& receipt : store.receipt_files()) {
    note("receipt", receipt, damage_of_receipt(receipt, store));
    ++all.receipts;
  }
  return all;
}

}  // namespace sediment::runner
