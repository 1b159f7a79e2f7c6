#include <catch2/catch.hpp>
#include <fstream>

#include "pipeline/contract/digest.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment::contract;

TEST_CASE("a digest is XXH3-128 in its canonical notation") {
  // Published value of XXH3-128 of no bytes (xxHash's own test vectors).
  CHECK(digest_bytes("") == "x3:99aa06d3014798d86001c324468d497f");
}

TEST_CASE("the digest of a file equals the digest of its bytes, across buffer borders") {
  const sediment::test::TemporaryFolder folder;
  const std::size_t size = GENERATE(0u, 1u, (1u << 18) - 1, 1u << 18, (1u << 20) + 17);
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 31 + i / 251);
  std::ofstream(folder / "bytes", std::ios::binary) << bytes;
  CHECK(digest_file(folder / "bytes") == digest_bytes(bytes));
}

TEST_CASE("a file that cannot be read is named") {
  CHECK_THROWS_WITH(digest_file("/nowhere/at/all"), Catch::Contains("/nowhere/at/all"));
}
