#include "tools/synthesize/seen_surface.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::synthetic {

SeenSurface::SeenSurface(const Scene& scene, double cell_m) : scene_(scene) {
  for (std::size_t body_idx = 0; body_idx < scene.bodies.size(); ++body_idx) {
    const Body& body = scene.bodies[body_idx];
    if (body.mobility != Mobility::fixed) continue;
    for (std::size_t i = 0; i < body.solids.size(); ++i) {
      first_grid_.push_back(static_cast<int>(grids_.size()));
      for (int face = 0; face < face_count(body.solids[i].shape); ++face) {
        const FaceRange range = face_range(body.solids[i], face);
        const double height = range.v_high_m - range.v_low_m;
        const int columns = std::max(1, static_cast<int>(std::lround(range.u_m / cell_m)));
        const int rows = std::max(1, static_cast<int>(std::lround(height / cell_m)));
        grids_.push_back({static_cast<int>(body_idx), static_cast<int>(i), face,
                          static_cast<int>(first_grid_.size()) - 1, columns, rows, range.u_m / columns,
                          height / rows, range.v_low_m,
                          std::vector<std::uint8_t>(static_cast<std::size_t>(columns) * rows, 0)});
      }
    }
  }
}

void SeenSurface::add(const Rendering& rendering, const Moment& moment, const cv::Mat& depth) {
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const int solid_idx = rendering.solid.at<int>(v, u);
      if (solid_idx < 0 || depth.at<std::uint16_t>(v, u) == 0) continue;
      const int fixed_idx = moment.solids[static_cast<std::size_t>(solid_idx)].fixed_idx;
      if (fixed_idx < 0) continue;
      Grid& grid = grids_[static_cast<std::size_t>(first_grid_[static_cast<std::size_t>(fixed_idx)]) +
                          rendering.face.at<std::uint8_t>(v, u)];
      const cv::Vec2f place = rendering.place.at<cv::Vec2f>(v, u);
      const int column = std::clamp(static_cast<int>(place[0] / grid.cell_u_m), 0, grid.columns - 1);
      const int row =
          std::clamp(static_cast<int>((place[1] - grid.v_low_m) / grid.cell_v_m), 0, grid.rows - 1);
      grid.seen[static_cast<std::size_t>(row) * grid.columns + column] = 1;
    }
}

LabelledPoint SeenSurface::point_of(const Grid& grid, int column, int row, const Lighting& lighting) const {
  const Solid& solid =
      scene_.bodies[static_cast<std::size_t>(grid.body_idx)].solids[static_cast<std::size_t>(grid.solid_idx)];
  const Material& material =
      scene_.materials[static_cast<std::size_t>(solid.materials[static_cast<std::size_t>(grid.face)])];
  const double u = (column + 0.5) * grid.cell_u_m, v = (row + 0.5) * grid.cell_v_m + grid.v_low_m;
  const Vec3 world = solid.body_from_solid * point_on(solid, grid.face, u, v);
  const Footprint cell{static_cast<float>(grid.cell_u_m), 0, 0, static_cast<float>(grid.cell_v_m)};
  const float uf = static_cast<float>(u), vf = static_cast<float>(v);
  const Rgb paint =
      material.tint * scene_.textures[static_cast<std::size_t>(material.texture)].sample(uf, vf, cell);
  const Rgb color = blend(paint * lighting.on_face(grid.fixed_idx, grid.face, uf, vf), paint, material.glow);
  const auto byte = [](float x) { return static_cast<std::uint8_t>(std::clamp(255 * x + 0.5f, 0.f, 255.f)); };
  return {static_cast<float>(world.x),
          static_cast<float>(world.y),
          static_cast<float>(world.z),
          byte(color.b),
          byte(color.g),
          byte(color.r),
          0,
          kUnlabelled,
          static_cast<std::uint32_t>(grid.body_idx + 1)};
}

LabelledCloud SeenSurface::cloud(const Lighting& lighting, const LabelTable& labels) const {
  LabelledCloud cloud;
  for (const Grid& grid : grids_) {
    const Label* label = labels.find(scene_.bodies[static_cast<std::size_t>(grid.body_idx)].class_name);
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        if (!grid.seen[static_cast<std::size_t>(row) * grid.columns + column]) continue;
        cloud.push_back(point_of(grid, column, row, lighting));
        if (label) cloud.back().label = label->id;
      }
  }
  return cloud;
}

}  // namespace sediment::synthetic
