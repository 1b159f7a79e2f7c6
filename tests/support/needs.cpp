#include "tests/support/needs.hpp"

#include <cstdlib>
#include <iostream>

namespace sediment::test {

std::optional<std::filesystem::path> needs(const std::string& relative) {
  const char* named = std::getenv("SEDIMENT_SHARED");
  const std::filesystem::path shared =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::path(SEDIMENT_SOURCE_DIR).parent_path() / "shared";
  if (std::filesystem::exists(shared / relative)) return shared / relative;
  std::cout << "skipped: needs shared/" << relative << std::endl;
  return std::nullopt;
}

}  // namespace sediment::test
