#include "pipeline/artifacts/coco_rle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace sediment {
namespace {

// Each character holds 5 bits, least significant group first; bit 5 says that more follow. From the fourth
// length on, the difference to the length two before is stored.
constexpr int kOffset = 48, kGroupBits = 5, kMore = 0x20, kSign = 0x10, kMask = 0x1f;

std::int64_t two_before(std::span<const std::uint32_t> lengths) {
  return lengths.size() > 2 ? lengths[lengths.size() - 2] : 0;
}

}  // namespace

RunLengths parse_run_lengths(std::string_view text) {
  RunLengths lengths;
  for (std::size_t i = 0; i < text.size();) {
    std::int64_t value = 0;
    for (int shift = 0;; shift += kGroupBits) {
      if (i == text.size() || shift > 30) throw std::runtime_error("run-length code is cut off");
      const int group = text[i++] - kOffset;
      if (group < 0 || group > 63) throw std::runtime_error("run-length code has a wrong character");
      value |= static_cast<std::int64_t>(group & kMask) << shift;
      if ((group & kMore) != 0) continue;
      if ((group & kSign) != 0) value -= std::int64_t{1} << (shift + kGroupBits);
      break;
    }
    value += two_before(lengths);
    if (value < 0 || value > UINT32_MAX) throw std::runtime_error("run-length code has a negative length");
    lengths.push_back(static_cast<std::uint32_t>(value));
  }
  return lengths;
}

std::string format_run_lengths(std::span<const std::uint32_t> lengths) {
  std::string text;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    std::int64_t value = lengths[i] - two_before(lengths.first(i));
    for (bool more = true; more;) {
      int group = static_cast<int>(value & kMask);
      value >>= kGroupBits;
      more = (group & kSign) != 0 ? value != -1 : value != 0;
      if (more) group |= kMore;
      text.push_back(static_cast<char>(group + kOffset));
    }
  }
  return text;
}

cv::Mat mask_from(std::span<const std::uint32_t> lengths, cv::Size size) {
  const std::uint64_t total = std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{0});
  if (total != static_cast<std::uint64_t>(size.area()))
    throw std::runtime_error("run lengths add up to " + std::to_string(total) + " pixels, expected " +
                             std::to_string(size.width) + " x " + std::to_string(size.height));
  cv::Mat columns = cv::Mat::zeros(size.width, size.height, CV_8UC1);  // transposed: a run lies in one piece
  auto* at = columns.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (i % 2 == 1) std::fill_n(at, lengths[i], std::uint8_t{255});
    at += lengths[i];
  }
  return columns.t();
}

RunLengths run_lengths_of(const cv::Mat& mask) {
  const cv::Mat columns = mask.t();
  RunLengths lengths{0};
  bool object = false;
  for (auto at = columns.begin<std::uint8_t>(); at != columns.end<std::uint8_t>(); ++at) {
    if ((*at != 0) != object) {
      object = !object;
      lengths.push_back(0);
    }
    ++lengths.back();
  }
  return lengths;
}

void fill_polygon(std::span<const double> corners, cv::Mat& mask) {
  const std::size_t count = corners.size() / 2;
  if (count < 3 || corners.size() % 2 != 0 ||
      !std::ranges::all_of(corners, [](double v) { return std::isfinite(v); }))
    throw std::runtime_error("a polygon needs x y of 3 corners at least, found " +
                             std::to_string(corners.size()) + " values");
  for (int row = 0; row < mask.rows; ++row) {
    const double y = row + 0.5;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const double y0 = corners[2 * i + 1], y1 = corners[2 * j + 1];
      if ((y0 <= y) == (y1 <= y)) continue;
      const double x0 = corners[2 * i], x1 = corners[2 * j];
      crossings.push_back(x0 + (y - y0) / (y1 - y0) * (x1 - x0));
    }
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto first = static_cast<int>(std::clamp(std::ceil(crossings[i] - 0.5), 0.0, mask.cols + 0.0));
      const auto end = static_cast<int>(std::clamp(std::ceil(crossings[i + 1] - 0.5), 0.0, mask.cols + 0.0));
      if (first < end) std::fill_n(mask.ptr<std::uint8_t>(row) + first, end - first, std::uint8_t{255});
    }
  }
}

}  // namespace sediment
