#include "pipeline/artifacts/lzf.hpp"

#include <pcl/io/lzf.h>

#include <catch2/catch.hpp>
#include <random>

using namespace sediment;

namespace {

/// Bytes with much, some or no repetition.
std::string some_bytes(std::size_t size, int alphabet) {
  std::mt19937 random(7);
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = i > 300 && random() % 3 == 0 ? bytes[i - 300] : static_cast<char>(random() % alphabet);
  return bytes;
}

}  // namespace

TEST_CASE("what LZF packs, it and PCL unpack; what PCL packs, it unpacks") {
  const std::size_t size = GENERATE(0, 1, 2, 3, 33, 264, 265, 1000, 100000);
  const int alphabet = GENERATE(1, 2, 256);
  const std::string bytes = some_bytes(size, alphabet);
  const std::string packed = lzf_compress(bytes);
  CHECK(lzf_decompress(packed, size) == bytes);
  if (alphabet == 1) CHECK(packed.size() <= 12 + size / 64);
  if (size == 0) return;

  std::string by_pcl(size, '\0');
  CHECK(pcl::lzfDecompress(packed.data(), static_cast<unsigned>(packed.size()), by_pcl.data(),
                           static_cast<unsigned>(size)) == size);
  CHECK(by_pcl == bytes);
  std::string packed_by_pcl(size * 2 + 64, '\0');
  const unsigned packed_size =
      pcl::lzfCompress(bytes.data(), static_cast<unsigned>(size), packed_by_pcl.data(),
                       static_cast<unsigned>(packed_by_pcl.size()));
  if (packed_size == 0) return;  // PCL packs nothing of fewer than four bytes
  packed_by_pcl.resize(packed_size);
  CHECK(lzf_decompress(packed_by_pcl, size) == bytes);
}

TEST_CASE("damaged LZF bytes are refused") {
  const std::string bytes = some_bytes(1000, 3);
  const std::string packed = lzf_compress(bytes);
  CHECK_THROWS(lzf_decompress(packed.substr(0, packed.size() - 1), bytes.size()));
  CHECK_THROWS(lzf_decompress(packed, bytes.size() - 1));
  CHECK_THROWS(lzf_decompress(packed, bytes.size() + 1));
  CHECK_THROWS(lzf_decompress("\x40\x10", 4));  // copies from before the beginning
  CHECK_THROWS(lzf_decompress("\xe0", 9));      // ends within a token
}
