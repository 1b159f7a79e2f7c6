#include "tools/synthesize/seen_surface.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synthesize/shading.hpp"

namespace sediment::synthetic {

SeenSurface::SeenSurface(const Scene& scene, double cell_m) : scene_(scene) {
  for (std::size_t body_idx = 0; body_idx < scene.bodies.size(); ++body_idx) {
    const Body& body = scene.bodies[body_idx];
    for (std::size_t i = 0; i < body.solids.size(); ++i) {
      first_grid_.push_back(body.mobility == Mobility::fixed ? static_cast<int>(grids_.size()) : -1);
      if (body.mobility != Mobility::fixed) continue;
      for (int face = 0; face < face_count(body.solids[i].shape); ++face) {
        // A capsule's v runs over its two round ends, too.
        FaceSize size = face_size(body.solids[i], face);
        if (body.solids[i].shape == Shape::capsule) size.v_m += body.solids[i].size.x + body.solids[i].size.y;
        const int columns = std::max(1, static_cast<int>(std::lround(size.u_m / cell_m)));
        const int rows = std::max(1, static_cast<int>(std::lround(size.v_m / cell_m)));
        grids_.push_back({static_cast<int>(body_idx), static_cast<int>(i), face, columns, rows,
                          size.u_m / columns, size.v_m / rows,
                          std::vector<std::uint8_t>(static_cast<std::size_t>(columns) * rows, 0)});
      }
    }
  }
}

void SeenSurface::add(const Rendering& rendering, const cv::Mat& depth) {
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const int solid_idx = rendering.solid.at<int>(v, u);
      if (solid_idx < 0 || depth.at<std::uint16_t>(v, u) == 0) continue;
      const int first = first_grid_[static_cast<std::size_t>(solid_idx)];
      if (first < 0) continue;
      Grid& grid = grids_[static_cast<std::size_t>(first) + rendering.face.at<std::uint8_t>(v, u)];
      const Solid& solid = scene_.bodies[static_cast<std::size_t>(grid.body_idx)]
                               .solids[static_cast<std::size_t>(grid.solid_idx)];
      const cv::Vec2f place = rendering.place.at<cv::Vec2f>(v, u);
      const double above = solid.shape == Shape::capsule ? solid.size.y : 0;
      const int column = std::clamp(static_cast<int>(place[0] / grid.cell_u_m), 0, grid.columns - 1);
      const int row = std::clamp(static_cast<int>((place[1] + above) / grid.cell_v_m), 0, grid.rows - 1);
      grid.seen[static_cast<std::size_t>(row) * grid.columns + column] = 1;
    }
}

LabelledCloud SeenSurface::cloud(const LabelTable& labels) const {
  LabelledCloud cloud;
  for (const Grid& grid : grids_) {
    const Body& body = scene_.bodies[static_cast<std::size_t>(grid.body_idx)];
    const Solid& solid = body.solids[static_cast<std::size_t>(grid.solid_idx)];
    const Label* label = labels.find(body.class_name);
    const Material& material =
        scene_.materials[static_cast<std::size_t>(solid.materials[static_cast<std::size_t>(grid.face)])];
    const double above = solid.shape == Shape::capsule ? solid.size.y : 0;
    const float cell_u = static_cast<float>(grid.cell_u_m), cell_v = static_cast<float>(grid.cell_v_m);
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        if (!grid.seen[static_cast<std::size_t>(row) * grid.columns + column]) continue;
        const double u = (column + 0.5) * grid.cell_u_m, v = (row + 0.5) * grid.cell_v_m - above;
        const Vec3 place = point_on(solid, grid.face, u, v);
        const Vec3 world = solid.body_from_solid * place;
        const Rgb paint =
            material.tint * scene_.textures[static_cast<std::size_t>(material.texture)].sample(
                                static_cast<float>(u), static_cast<float>(v), {cell_u, 0, 0, cell_v});
        const Rgb lit =
            paint * light_at(scene_, world, solid.body_from_solid.rotate(surface_at(solid, place).normal));
        const auto byte = [](float x) {
          return static_cast<std::uint8_t>(std::clamp(255 * x + 0.5f, 0.f, 255.f));
        };
        cloud.push_back({static_cast<float>(world.x), static_cast<float>(world.y),
                         static_cast<float>(world.z), byte(lit.b), byte(lit.g), byte(lit.r), 0,
                         label ? label->id : kUnlabelled, static_cast<std::uint32_t>(grid.body_idx + 1)});
      }
  }
  return cloud;
}

}  // namespace sediment::synthetic
