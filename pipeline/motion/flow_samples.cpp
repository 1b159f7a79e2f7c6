#include <opencv2/core.hpp>

#include "pipeline/motion/optical_flow.hpp"
#include "pipeline/scene/vector_clones.hpp"

namespace sediment {
namespace {

/// A flow field as bare numbers.
struct Grid {
  const float* values;  ///< x and y by turns
  int columns, last_left, last_top;
  float cells_per_px_x, cells_per_px_y, last_x, last_y;
};

/// The sums of FlowField::at in the same order.
SEDIMENT_CLONES void sample(const Grid& grid, const float* __restrict u, const float* __restrict v,
                            std::size_t count, float* __restrict du, float* __restrict dv) {
  const float* const values = grid.values;
  const int columns = grid.columns, last_left = grid.last_left, last_top = grid.last_top;
  const float per_x = grid.cells_per_px_x, per_y = grid.cells_per_px_y, last_x = grid.last_x,
              last_y = grid.last_y;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = std::min(std::max((u[i] + 0.5F) * per_x - 0.5F, 0.0F), last_x);
    const float y = std::min(std::max((v[i] + 0.5F) * per_y - 0.5F, 0.0F), last_y);
    const int left = std::min(static_cast<int>(x), last_left), top = std::min(static_cast<int>(y), last_top);
    const float right_share = x - static_cast<float>(left), lower_share = y - static_cast<float>(top);
    const int upper = 2 * (top * columns + left), lower = upper + 2 * columns;
    const float upper_x = (1 - right_share) * values[upper] + right_share * values[upper + 2];
    const float upper_y = (1 - right_share) * values[upper + 1] + right_share * values[upper + 3];
    const float lower_x = (1 - right_share) * values[lower] + right_share * values[lower + 2];
    const float lower_y = (1 - right_share) * values[lower + 1] + right_share * values[lower + 3];
    du[i] = (1 - lower_share) * upper_x + lower_share * lower_x;
    dv[i] = (1 - lower_share) * upper_y + lower_share * lower_y;
  }
}

}  // namespace

void FlowField::at_each(const float* u, const float* v, std::size_t count, float* du, float* dv) const {
  const Grid grid{grid_.ptr<float>(), grid_.cols,      grid_.cols - 2, grid_.rows - 2,
                  cells_per_px_x_,    cells_per_px_y_, last_x_,        last_y_};
  sample(grid, u, v, count, du, dv);
}

}  // namespace sediment
