#include "pipeline/artifacts/sequence.hpp"

#include <algorithm>
#include <stdexcept>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/sequence_file.hpp"
#include "pipeline/artifacts/text_table.hpp"

namespace sediment {
namespace {

/// One line of rgb.txt or depth.txt.
struct ListedImage {
  std::string stamp, name;
  double stamp_s = 0;
  int line = 0;
};

std::vector<ListedImage> read_list(const std::filesystem::path& file) {
  std::vector<ListedImage> images;
  read_rows(file, [&](const TextRow& row) {
    if (row.columns.size() != 2)
      throw std::runtime_error("expected 2 columns (timestamp file), found " +
                               std::to_string(row.columns.size()));
    images.push_back({std::string(row.columns[0]), std::string(row.columns[1]),
                      expect_number(row.columns[0], "timestamp"), row.line});
  });
  if (images.empty()) throw std::runtime_error(file.string() + ": lists no image");
  std::stable_sort(images.begin(), images.end(),
                   [](const ListedImage& a, const ListedImage& b) { return a.stamp_s < b.stamp_s; });
  for (std::size_t i = 1; i < images.size(); ++i)
    if (images[i].stamp_s == images[i - 1].stamp_s)
      throw std::runtime_error(file.string() + ":" + std::to_string(images[i].line) + ": stamp " +
                               images[i].stamp + " is given twice (first in line " +
                               std::to_string(images[i - 1].line) + ")");
  return images;
}

std::vector<double> stamps_of(const std::vector<ListedImage>& images) {
  std::vector<double> stamps_s;
  for (const ListedImage& image : images) stamps_s.push_back(image.stamp_s);
  return stamps_s;
}

std::string place(const std::filesystem::path& list, int line) {
  return list.string() + ":" + std::to_string(line) + ": ";
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void check_size(int width, int height, const Camera& camera, const std::filesystem::path& image) {
  if (width != camera.width || height != camera.height)
    throw std::runtime_error(image.string() + ": expected " + size_text(camera.width, camera.height) +
                             " pixels as the camera says, found " + size_text(width, height));
}

void check_header(const std::filesystem::path& image, const Camera& camera, bool is_depth) {
  const ImageHeader header = probe_image(image);
  check_size(header.width, header.height, camera, image);
  if (is_depth && (header.bits != 16 || header.channels != 1))
    throw std::runtime_error(image.string() + ": expected a depth image of 16 bits in one channel, found " +
                             std::to_string(header.bits) + " bits in " + std::to_string(header.channels));
  if (!is_depth && header.bits != 8)
    throw std::runtime_error(image.string() + ": expected a colour image of 8 bits, found " +
                             std::to_string(header.bits));
}

/// Runs what concerns one listed image; errors get the line of the list in front.
template <class Body>
auto at_line(const std::filesystem::path& list, int line, const Body& body) {
  try {
    return body();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(place(list, line) + error.what());
  }
}

std::size_t count_within(const std::vector<ListedImage>& images, double first_s, double last_s) {
  return static_cast<std::size_t>(std::count_if(images.begin(), images.end(), [&](const ListedImage& image) {
    return image.stamp_s >= first_s && image.stamp_s <= last_s;
  }));
}

std::vector<SequenceEntry> pair_up(const SequenceFile& file, const std::vector<ListedImage>& colors,
                                   const std::vector<ListedImage>& depths) {
  std::vector<SequenceEntry> entries;
  for (const auto& [color_idx, depth_idx] :
       associate(stamps_of(colors), stamps_of(depths), file.tolerance_s)) {
    const ListedImage &color = colors[color_idx], &depth = depths[depth_idx];
    entries.push_back({color.stamp, color.stamp_s, depth.stamp_s, file.root / color.name,
                       file.root / depth.name, color.line, depth.line});
  }
  if (entries.empty())
    throw std::runtime_error(file.color_list.string() + ": no image has a depth image of " +
                             file.depth_list.string() + " within " + std::to_string(file.tolerance_s) + " s");
  return entries;
}

}  // namespace

Sequence Sequence::open(const std::filesystem::path& yaml) {
  const SequenceFile file = read_sequence_file(yaml);
  const auto colors = read_list(file.color_list), depths = read_list(file.depth_list);
  auto associated = pair_up(file, colors, depths);
  if (file.start >= associated.size())
    throw std::runtime_error(yaml.string() + ": the window starts at frame " + std::to_string(file.start) +
                             ", but there are " + std::to_string(associated.size()));
  Sequence sequence;
  sequence.camera_ = file.camera;
  sequence.color_list_ = file.color_list;
  sequence.depth_list_ = file.depth_list;
  sequence.groundtruth_ = file.groundtruth;
  sequence.accelerometer_ = file.accelerometer;
  std::size_t idx = file.start;
  for (; idx < associated.size() && (file.count == 0 || sequence.entries_.size() < file.count);
       idx += file.stride)
    sequence.entries_.push_back(std::move(associated[idx]));
  const SequenceEntry &first = sequence.entries_.front(), &last = sequence.entries_.back();
  const std::size_t between = (sequence.entries_.size() - 1) * file.stride + 1;
  sequence.unassociated_ = count_within(colors, first.stamp_s, last.stamp_s) - between +
                           count_within(depths, first.depth_stamp_s, last.depth_stamp_s) - between;
  for (const SequenceEntry& entry : sequence.entries_) {
    at_line(file.color_list, entry.color_line, [&] { check_header(entry.color, file.camera, false); });
    at_line(file.depth_list, entry.depth_line, [&] { check_header(entry.depth, file.camera, true); });
  }
  return sequence;
}

cv::Mat Sequence::color(std::size_t frame_idx) const {
  const SequenceEntry& of = entry(frame_idx);
  return at_line(color_list_, of.color_line, [&] {
    cv::Mat image = read_color(of.color);
    check_size(image.cols, image.rows, camera_, of.color);
    return image;
  });
}

cv::Mat Sequence::depth(std::size_t frame_idx) const {
  const SequenceEntry& of = entry(frame_idx);
  return at_line(depth_list_, of.depth_line, [&] {
    cv::Mat image = read_gray16(of.depth);
    check_size(image.cols, image.rows, camera_, of.depth);
    return image;
  });
}

Frame Sequence::frame(std::size_t frame_idx) const {
  return {frame_idx, entry(frame_idx).stamp, entry(frame_idx).stamp_s, color(frame_idx), depth(frame_idx)};
}

}  // namespace sediment
