#include "stages/voxel/voxel_buckets.hpp"

#include <sys/mman.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <new>
#include <utility>

namespace sediment::voxel {
namespace {

constexpr int kDigitBits = 12;
constexpr std::size_t kBucketPoints = 1 << 13;  // 192 KiB
constexpr std::size_t kMostBuckets = 1024;      // open write streams
constexpr std::size_t kLeastBlock = 1 << 15;
constexpr std::size_t kMostBlocks = 64;

/// Parts of the cloud that are worked on one at a time, depending on nothing but its size.
struct Blocks {
  explicit Blocks(std::size_t points)
      : size(points), count(std::clamp<std::size_t>(points / kLeastBlock, 1, kMostBlocks)) {}
  std::size_t begin(std::size_t block) const { return size * block / count; }
  std::size_t size, count;
};

template <class Visit>
void for_each_key(const LabelledCloud& cloud, const VoxelKeys& keys, const Blocks& blocks, std::size_t block,
                  Visit visit) {
  for (std::size_t i = blocks.begin(block); i < blocks.begin(block + 1); ++i)
    if (const std::uint64_t key = keys.of(cloud[i]); key != VoxelKeys::kNone) visit(key, cloud[i]);
}

/// Joins neighbouring digits until a bucket is full. Returns the bucket of each digit.
std::vector<std::uint32_t> bucket_of_digits(const std::vector<std::size_t>& points_of_digit,
                                            std::size_t bucket_points) {
  std::vector<std::uint32_t> bucket(points_of_digit.size());
  std::uint32_t current = 0;
  std::size_t filled = 0;
  for (std::size_t digit = 0; digit < bucket.size(); ++digit) {
    if (filled > 0 && filled + points_of_digit[digit] > bucket_points) {
      ++current;
      filled = 0;
    }
    bucket[digit] = current;
    filled += points_of_digit[digit];
  }
  return bucket;
}

}  // namespace

PointBuffer::PointBuffer(std::size_t points) {
  constexpr std::size_t kHugePage = std::size_t{1} << 21;
  const std::size_t bytes = (points * sizeof(LabelledPoint) + kHugePage - 1) / kHugePage * kHugePage;
  if (bytes == 0) return;
  void* const memory = std::aligned_alloc(kHugePage, bytes);
  if (memory == nullptr) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);  // a hint: without it all is the same, but slower
  points_.reset(static_cast<LabelledPoint*>(memory));
}

Buckets part_into_buckets(const LabelledCloud& cloud, const VoxelKeys& keys) {
  const int digit_bits = std::min(kDigitBits, keys.bits()), shift = keys.bits() - digit_bits;
  const std::size_t digits = std::size_t{1} << digit_bits;
  const Blocks blocks(cloud.size());
  std::vector<std::vector<std::uint32_t>> counts(blocks.count, std::vector<std::uint32_t>(digits, 0));
  tbb::parallel_for(std::size_t{0}, blocks.count, [&](std::size_t block) {
    auto& own = counts[block];
    for_each_key(cloud, keys, blocks, block,
                 [&](std::uint64_t key, const LabelledPoint&) { ++own[key >> shift]; });
  });
  std::vector<std::size_t> points_of_digit(digits, 0);
  for (const auto& own : counts)
    for (std::size_t digit = 0; digit < digits; ++digit) points_of_digit[digit] += own[digit];

  const auto bucket = bucket_of_digits(points_of_digit, std::max(kBucketPoints, cloud.size() / kMostBuckets));
  const std::size_t bucket_count = bucket.back() + std::size_t{1};
  std::vector<std::vector<std::size_t>> places(blocks.count, std::vector<std::size_t>(bucket_count, 0));
  for (std::size_t block = 0; block < blocks.count; ++block)
    for (std::size_t digit = 0; digit < digits; ++digit) places[block][bucket[digit]] += counts[block][digit];
  Buckets buckets;
  std::size_t place = 0;
  for (std::size_t i = 0; i < bucket_count; ++i) {
    buckets.begin.push_back(place);
    for (auto& own : places) place += std::exchange(own[i], place);
  }
  buckets.begin.push_back(place);

  buckets.points = PointBuffer(place);
  tbb::parallel_for(std::size_t{0}, blocks.count, [&](std::size_t block) {
    auto& own = places[block];
    for_each_key(cloud, keys, blocks, block, [&](std::uint64_t key, const LabelledPoint& point) {
      buckets.points.data()[own[bucket[key >> shift]]++] = point;
    });
  });
  return buckets;
}

}  // namespace sediment::voxel
