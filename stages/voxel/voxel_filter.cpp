#include "stages/voxel/voxel_filter.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <utility>

#include "stages/voxel/voxel_keys.hpp"

namespace sediment::voxel {
namespace {

using LabelAndInstance = std::pair<std::uint32_t, std::uint32_t>;

/// First value of the longest run in a sorted range.
template <class Iterator, class Value>
std::pair<Iterator, Iterator> longest_run(Iterator begin, Iterator end, Value value_of) {
  std::pair<Iterator, Iterator> longest{begin, begin};
  for (Iterator run = begin; run != end;) {
    const Iterator next =
        std::find_if(run, end, [&](const auto& item) { return value_of(item) != value_of(*run); });
    if (next - run > longest.second - longest.first) longest = {run, next};
    run = next;
  }
  return longest;
}

LabelAndInstance vote(std::vector<LabelAndInstance>& votes) {
  const bool agreed = std::all_of(votes.begin(), votes.end(), [&](const auto& v) { return v == votes[0]; });
  if (agreed) return votes[0];
  std::sort(votes.begin(), votes.end());
  const auto label = [](const LabelAndInstance& v) { return v.first; };
  const auto instance = [](const LabelAndInstance& v) { return v.second; };
  const auto [begin, end] = longest_run(votes.begin(), votes.end(), label);
  return *longest_run(begin, end, instance).first;
}

std::uint8_t rounded_mean(std::uint64_t sum, std::uint64_t count) {
  return static_cast<std::uint8_t>((2 * sum + count) / (2 * count));
}

LabelledPoint merge(const LabelledCloud& cloud, std::span<const std::uint32_t> indices,
                    std::vector<LabelAndInstance>& votes) {
  double x = 0, y = 0, z = 0;
  std::uint64_t b = 0, g = 0, r = 0;
  votes.clear();
  for (const std::uint32_t idx : indices) {
    const LabelledPoint& p = cloud[idx];
    x += p.x;
    y += p.y;
    z += p.z;
    b += p.b;
    g += p.g;
    r += p.r;
    votes.emplace_back(p.label, p.instance);
  }
  const std::uint64_t count = indices.size();
  const auto mean = [&](double sum) { return static_cast<float>(sum / static_cast<double>(count)); };
  const auto [label, instance] = vote(votes);
  return {mean(x), mean(y), mean(z), rounded_mean(b, count), rounded_mean(g, count), rounded_mean(r, count),
          0,       label,   instance};
}

}  // namespace

LabelledCloud filter(const LabelledCloud& cloud, const Parameters& parameters, Statistics& statistics) {
  const KeyedPoints points = sort_into_voxels(cloud, static_cast<float>(parameters.leaf));
  statistics.points = cloud.size();
  statistics.not_finite = cloud.size() - points.keys.size();

  std::vector<std::pair<std::size_t, std::size_t>> runs;  // of points in one voxel
  for (std::size_t begin = 0; begin < points.keys.size();) {
    std::size_t end = begin + 1;
    while (end < points.keys.size() && points.keys[end] == points.keys[begin]) ++end;
    ++statistics.voxels;
    if (end - begin >= static_cast<std::size_t>(parameters.min_points))
      runs.emplace_back(begin, end);
    else
      ++statistics.too_sparse;
    begin = end;
  }

  LabelledCloud merged(runs.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs.size(), 4096), [&](const auto& range) {
    std::vector<LabelAndInstance> votes;
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      merged[i] = merge(
          cloud, std::span(points.point_idx).subspan(runs[i].first, runs[i].second - runs[i].first), votes);
  });
  return merged;
}

}  // namespace sediment::voxel
