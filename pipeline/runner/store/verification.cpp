#include "pipeline/runner/store/verification.hpp"

#include <fstream>
#include <iterator>
#include <random>

#include "pipeline/contract/progress.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

/// The entries of FOLDER/ab/.
std::vector<fs::path> sharded_entries(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code ignored;
  for (const auto& shard : fs::directory_iterator(folder, ignored))
    for (const auto& entry : fs::directory_iterator(shard.path(), ignored)) all.push_back(entry.path());
  return all;
}

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

std::string damage_of_receipt(const fs::path& file, const Store& store) try {
  std::ifstream stream(file, std::ios::binary);
  const Receipt receipt = receipt_from(std::string(std::istreambuf_iterator<char>(stream), {}));
  if (store.receipt_path(receipt.key) != file) return "it is not the receipt its name says";
  if (!fs::exists(store.object_path(receipt.object))) return "its result is gone";
  return "";
} catch (const std::exception& error) {
  return error.what();
}

}  // namespace

Verification verify(const Store& store, double share) {
  Verification all;
  const auto note = [&](const char* what, const fs::path& path, const std::string& damage) {
    if (damage.empty()) return;
    all.damages.push_back(std::string(what) + ' ' + path.string() + ": " + damage);
    store.put_aside(path);
  };
  std::vector<fs::path> objects = sharded_entries(store.root() / "objects"), sample;
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
  for (const fs::path& receipt : sharded_entries(store.root() / "receipts")) {
    note("receipt", receipt, damage_of_receipt(receipt, store));
    ++all.receipts;
  }
  return all;
}

}  // namespace sediment::runner
