#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "pipeline/artifacts/grid_map.hpp"
#include "tools/render/annotation.hpp"
#include "tools/render/pictures.hpp"

namespace sediment::render {
namespace {

const cv::Vec3b kOccupied{54, 40, 32}, kFree{255, 255, 255}, kUnknown{222, 214, 205};
const cv::Scalar kLine(232, 226, 220);

cv::Vec3b color_of(Cell cell) {
  return cell == Cell::occupied ? kOccupied : cell == Cell::free ? kFree : kUnknown;
}

/// A line each metre, with its coordinate, under the obstacles.
void add_metres(cv::Mat& picture, const GridMap& map, int cell_px) {
  const double px_per_metre = cell_px / map.resolution_m;
  const double step_m = px_per_metre < 40 ? 5 : 1;
  const auto label = [](double metres) {
    char text[16];
    std::snprintf(text, sizeof text, "%g", metres + 0.0);  // -0 becomes 0
    return std::string(text);
  };
  cv::Mat lines = picture.clone();
  for (double x = std::ceil(map.origin_x_m / step_m) * step_m;
       x < map.origin_x_m + map.width * map.resolution_m; x += step_m) {
    const int u = static_cast<int>((x - map.origin_x_m) * px_per_metre);
    cv::line(lines, {u, 0}, {u, lines.rows}, x == 0 ? cv::Scalar(150, 150, 230) : kLine);
    write_text(lines, label(x), {u + 3, lines.rows - 5}, 0.8, {120, 120, 120});
  }
  for (double y = std::ceil(map.origin_y_m / step_m) * step_m;
       y < map.origin_y_m + map.height * map.resolution_m; y += step_m) {
    const int v = lines.rows - static_cast<int>((y - map.origin_y_m) * px_per_metre);
    cv::line(lines, {0, v}, {lines.cols, v}, y == 0 ? cv::Scalar(150, 230, 150) : kLine);
    write_text(lines, label(y), {3, v - 4}, 0.8, {120, 120, 120});
  }
  cv::Mat occupied;
  cv::inRange(picture, cv::Scalar(kOccupied), cv::Scalar(kOccupied), occupied);
  picture.copyTo(lines, occupied);
  picture = lines;
}

}  // namespace

cv::Mat grid_picture(const std::filesystem::path& folder, int least_px, const std::string& title) {
  const GridMap map = read_grid_map(folder);
  cv::Mat cells(map.height, map.width, CV_8UC3);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) cells.at<cv::Vec3b>(map.height - 1 - y, x) = color_of(map.at(x, y));
  const int cell_px =
      std::max(1, (least_px + std::max(map.width, map.height) - 1) / std::max(map.width, map.height));
  cv::Mat picture;
  cv::resize(cells, picture, cells.size() * cell_px, 0, 0, cv::INTER_NEAREST);
  add_metres(picture, map, cell_px);
  const int top = title.empty() ? 12 : 56, bottom = 104;
  cv::copyMakeBorder(picture, picture, top, bottom, 12, 12, cv::BORDER_CONSTANT, cv::Scalar(250, 250, 250));
  add_title(picture, title);
  add_scale_bar(picture, cell_px / map.resolution_m);
  const bool unknown = std::find(map.cells.begin(), map.cells.end(), Cell::unknown) != map.cells.end();
  cv::Mat legend = picture.rowRange(picture.rows - bottom, picture.rows);
  std::vector<LegendEntry> entries{{kOccupied, "occupied"}, {kFree, "free"}};
  if (unknown) entries.push_back({kUnknown, "unknown"});
  add_legend(legend, entries);
  if (!map.ground_source.empty())
    write_text(picture, "ground: " + map.ground_source, {22, picture.rows - bottom + 26}, 0.85,
               {110, 110, 110});
  return picture;
}

}  // namespace sediment::render
