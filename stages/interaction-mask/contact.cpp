#include "stages/interaction-mask/contact.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace sediment::interaction_mask {
namespace {

/// Pixels first .. last of one row that belong to one instance; `index` counts within its side.
struct Run {
  int first, last, index;
};

/// The runs of one side (dynamic or static), row by row, from left to right.
struct RunRows {
  std::vector<Run> runs;
  std::vector<std::size_t> row_begin{0};

  std::span<const Run> row(int y) const {
    return std::span(runs).subspan(row_begin[y], row_begin[y + 1] - row_begin[y]);
  }
};

/// What an id stands for: its index on a side, or none.
struct Role {
  int dynamic_idx = -1, static_idx = -1;
};

std::vector<Role> roles_of(std::span<const int> dynamic_ids, std::span<const int> static_ids) {
  std::vector<Role> roles(1);
  const auto role = [&](int id) -> Role& {
    if (id < 1 || id > 65535)
      throw std::invalid_argument("instance id " + std::to_string(id) + ": expected 1 .. 65535");
    if (roles.size() <= static_cast<std::size_t>(id)) roles.resize(id + 1);
    return roles[id];
  };
  for (std::size_t i = 0; i < dynamic_ids.size(); ++i) role(dynamic_ids[i]).dynamic_idx = static_cast<int>(i);
  for (std::size_t i = 0; i < static_ids.size(); ++i) role(static_ids[i]).static_idx = static_cast<int>(i);
  return roles;
}

/// The first column after x whose id differs from that at x. Four pixels are compared at a time.
int run_end(const std::uint16_t* row, int x, int width) {
  std::uint64_t pattern = row[x] * 0x0001000100010001ULL, four;
  while (x + 4 <= width && (std::memcpy(&four, row + x, sizeof four), four == pattern)) x += 4;
  while (x < width && row[x] == static_cast<std::uint16_t>(pattern)) ++x;
  return x;
}

void split_into_runs(const cv::Mat& ids, const std::vector<Role>& roles, RunRows& dynamic, RunRows& fixed) {
  for (int y = 0; y < ids.rows; ++y) {
    const auto* row = ids.ptr<std::uint16_t>(y);
    for (int x = 0; x < ids.cols;) {
      const int end = run_end(row, x, ids.cols);
      if (row[x] < roles.size()) {
        const Role role = roles[row[x]];
        if (role.dynamic_idx >= 0) dynamic.runs.push_back({x, end - 1, role.dynamic_idx});
        if (role.static_idx >= 0) fixed.runs.push_back({x, end - 1, role.static_idx});
      }
      x = end;
    }
    dynamic.row_begin.push_back(dynamic.runs.size());
    fixed.row_begin.push_back(fixed.runs.size());
  }
}

/// Half width of the disc at each row distance 0 .. floor(radius).
std::vector<int> disc_half_widths(double radius_px) {
  std::vector<int> half;
  for (int dy = 0; dy <= radius_px; ++dy) {
    int dx = 0;
    while (static_cast<double>(dx + 1) * (dx + 1) + static_cast<double>(dy) * dy <= radius_px * radius_px)
      ++dx;
    half.push_back(dx);
  }
  return half;
}

void add_row(const std::uint16_t* a, const std::uint16_t* b, int count, ContactSum& sum) {
  std::uint64_t pairs = 0, difference = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t both = a[i] != 0 && b[i] != 0;
    const std::uint32_t apart = static_cast<std::uint32_t>(a[i] < b[i] ? b[i] - a[i] : a[i] - b[i]);
    pairs += both;
    difference += apart & (0 - both);
  }
  sum.pixel_pairs += pairs;
  sum.depth_difference += difference;
}

/// All pairs between two runs whose columns are at most `half` apart: one stretch for each column distance.
void add_runs(const Run& a, const std::uint16_t* depth_a, const Run& b, const std::uint16_t* depth_b,
              int half, ContactSum& sum) {
  const int nearest = std::max(-half, b.first - a.last), farthest = std::min(half, b.last - a.first);
  for (int dx = nearest; dx <= farthest; ++dx) {
    const int first = std::max(a.first, b.first - dx), last = std::min(a.last, b.last - dx);
    add_row(depth_a + first, depth_b + first + dx, last - first + 1, sum);
  }
}

}  // namespace

std::vector<ContactSum> contact_sums(const cv::Mat& ids, const cv::Mat& depth,
                                     std::span<const int> dynamic_ids, std::span<const int> static_ids,
                                     double radius_px) {
  if (ids.type() != CV_16UC1 || depth.type() != CV_16UC1 || ids.size() != depth.size())
    throw std::invalid_argument("contact_sums: instance ids and depth must be 16-bit images of one size");
  std::vector<ContactSum> sums(dynamic_ids.size() * static_ids.size());
  if (sums.empty()) return sums;

  RunRows dynamic, fixed;
  split_into_runs(ids, roles_of(dynamic_ids, static_ids), dynamic, fixed);
  const std::vector<int> half_widths = disc_half_widths(radius_px);
  const int reach = static_cast<int>(half_widths.size()) - 1;
  for (int y = 0; y < ids.rows; ++y) {
    if (dynamic.row(y).empty()) continue;
    for (int other = std::max(0, y - reach); other <= std::min(ids.rows - 1, y + reach); ++other) {
      const int half = half_widths[std::abs(other - y)];
      const auto candidates = fixed.row(other);
      auto next = candidates.begin();
      for (const Run& a : dynamic.row(y)) {
        // Runs are in order on both sides: what ends before this one's reach is behind all later ones too.
        while (next != candidates.end() && next->last < a.first - half) ++next;
        for (auto b = next; b != candidates.end() && b->first <= a.last + half; ++b)
          add_runs(a, depth.ptr<std::uint16_t>(y), *b, depth.ptr<std::uint16_t>(other), half,
                   sums[a.index * static_ids.size() + b->index]);
      }
    }
  }
  return sums;
}

}  // namespace sediment::interaction_mask
