#include <fmt/format.h>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/commands.hpp"
#include "pipeline/runner/commands/opened_pipeline.hpp"
#include "pipeline/runner/execution/text_table.hpp"
#include "pipeline/runner/store/verification.hpp"

namespace sediment::runner {

int verify_store(const Arguments& arguments) {
  const Store store(store_of(arguments));
  const Verification found = verify(store, arguments.share);
  for (const std::string& damage : found.damages) fmt::print("{}\n", damage);
  fmt::print("{} receipts and {} results ({}) checked in {}: {}\n", found.receipts, found.objects,
             shown_bytes(found.bytes), store.root().string(),
             found.damages.empty()
                 ? "all well"
                 : fmt::format("{} damaged and put aside; a run makes them again", found.damages.size()));
  return found.damages.empty() ? contract::kDone : contract::kFailed;
}

}  // namespace sediment::runner
