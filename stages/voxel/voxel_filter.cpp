#include "stages/voxel/voxel_filter.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <utility>

#include "pipeline/sorting/radix_sort.hpp"
#include "stages/voxel/voxel_buckets.hpp"

namespace sediment::voxel {
namespace {

/// The most frequent value, the smallest of several. The order of the values is lost. Not empty.
std::uint32_t majority(std::span<std::uint32_t> values) {
  // A voxel has points of few labels: they are counted in a short list. If it gets long, the values are
  // sorted.
  struct Count {
    std::uint32_t value, count;
  };
  constexpr std::size_t kShort = 8;
  std::array<Count, kShort> counts;
  std::size_t distinct = 0;
  const auto better = [](const Count& a, const Count& b) {
    return a.count != b.count ? a.count > b.count : a.value < b.value;
  };
  for (const std::uint32_t value : values) {
    std::size_t i = 0;
    while (i < distinct && counts[i].value != value) ++i;
    if (i < distinct)
      ++counts[i].count;
    else if (distinct == kShort) {
      distinct = kShort + 1;
      break;
    } else
      counts[distinct++] = {value, 1};
  }
  if (distinct <= kShort)
    return std::min_element(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(distinct), better)
        ->value;
  std::sort(values.begin(), values.end());
  Count best{0, 0};
  for (auto run = values.begin(); run != values.end();) {
    const auto next = std::find_if(run, values.end(), [&](std::uint32_t value) { return value != *run; });
    if (const Count count{*run, static_cast<std::uint32_t>(next - run)}; better(count, best)) best = count;
    run = next;
  }
  return best.value;
}

/// To the nearest. The quotient of whole numbers this small is off a half by more than its rounding, or
/// exact.
std::uint8_t rounded_mean(std::uint64_t sum, double count) {
  return static_cast<std::uint8_t>(static_cast<double>(sum) / count + 0.5);
}

/// The points of one voxel, in the order of the cloud.
LabelledPoint merge(std::span<const LabelledPoint> bucket, std::span<const std::uint32_t> indices,
                    std::vector<std::uint32_t>& votes) {
  const LabelledPoint& first = bucket[indices.front()];
  if (indices.size() == 1)
    return {first.x, first.y, first.z, first.b, first.g, first.r, 0, first.label, first.instance};
  double x = 0, y = 0, z = 0;
  std::uint64_t b = 0, g = 0, r = 0;
  bool agreed = true;
  for (const std::uint32_t idx : indices) {
    const LabelledPoint& p = bucket[idx];
    x += p.x;
    y += p.y;
    z += p.z;
    b += p.b;
    g += p.g;
    r += p.r;
    agreed = agreed && p.label == first.label && p.instance == first.instance;
  }
  const auto count = static_cast<double>(indices.size());
  LabelledPoint merged{static_cast<float>(x / count),
                       static_cast<float>(y / count),
                       static_cast<float>(z / count),
                       rounded_mean(b, count),
                       rounded_mean(g, count),
                       rounded_mean(r, count),
                       0,
                       first.label,
                       first.instance};
  if (agreed) return merged;
  votes.clear();
  for (const std::uint32_t idx : indices) votes.push_back(bucket[idx].label);
  merged.label = majority(votes);
  votes.clear();
  for (const std::uint32_t idx : indices)
    if (bucket[idx].label == merged.label) votes.push_back(bucket[idx].instance);
  merged.instance = majority(votes);
  return merged;
}

/// What a thread keeps between buckets.
struct Workspace {
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> votes;
  LabelledCloud merged;
};

struct Merged {
  std::size_t points = 0;  ///< that came out
  std::size_t voxels = 0;  ///< with the too sparse ones
};

/// Replaces the points of a bucket by one for each voxel, at its front: memory that is there already.
Merged merge_bucket(std::span<LabelledPoint> bucket, const VoxelKeys& keys, std::size_t min_points,
                    Workspace& work) {
  const std::size_t size = bucket.size();
  work.keys.resize(size);
  work.indices.resize(size);
  // All keys of a bucket have their first digits in common: only what differs is sorted.
  std::uint64_t differing = 0;
  for (std::size_t i = 0; i < size; ++i) {
    work.keys[i] = keys.of(bucket[i]);
    work.indices[i] = static_cast<std::uint32_t>(i);
    differing |= work.keys[i] ^ work.keys[0];
  }
  sort_by_key(work.keys, work.indices, std::bit_width(differing));
  work.merged.clear();
  Merged merged;
  for (std::size_t begin = 0, end = 0; begin < size; begin = end) {
    for (end = begin + 1; end < size && work.keys[end] == work.keys[begin];) ++end;
    ++merged.voxels;
    if (end - begin >= min_points)
      work.merged.push_back(merge(bucket, std::span(work.indices).subspan(begin, end - begin), work.votes));
  }
  merged.points = work.merged.size();
  for (std::size_t i = 0; i < merged.points; ++i) bucket[i] = work.merged[i];
  return merged;
}

}  // namespace

LabelledCloud filter(const LabelledCloud& cloud, const Parameters& parameters, Statistics& statistics) {
  const VoxelKeys keys(cloud, static_cast<float>(parameters.leaf));
  Buckets buckets = part_into_buckets(cloud, keys);
  std::vector<Merged> merged(buckets.count());
  tbb::enumerable_thread_specific<Workspace> workspaces;
  tbb::parallel_for(std::size_t{0}, merged.size(), [&](std::size_t i) {
    merged[i] = merge_bucket(buckets.bucket(i), keys, static_cast<std::size_t>(parameters.min_points),
                             workspaces.local());
  });

  std::vector<std::size_t> begin(merged.size() + 1, 0);
  statistics = {cloud.size(), cloud.size() - buckets.size(), 0, 0};
  for (std::size_t i = 0; i < merged.size(); ++i) {
    begin[i + 1] = begin[i] + merged[i].points;
    statistics.voxels += merged[i].voxels;
  }
  statistics.too_sparse = statistics.voxels - begin.back();
  LabelledCloud points(begin.back());
  tbb::parallel_for(std::size_t{0}, merged.size(), [&](std::size_t i) {
    const auto bucket = buckets.bucket(i).first(merged[i].points);
    std::copy(bucket.begin(), bucket.end(), points.begin() + static_cast<std::ptrdiff_t>(begin[i]));
  });
  return points;
}

}  // namespace sediment::voxel
