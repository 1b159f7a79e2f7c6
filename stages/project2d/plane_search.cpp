#include "stages/project2d/plane_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sediment::project2d {
namespace {

constexpr std::size_t kMostPlanes = 12;
constexpr std::size_t kMostHypotheses = 2000;
constexpr int kRefinements = 8;
const double kAgreeing = std::cos(20 * std::numbers::pi / 180);

std::vector<std::size_t> supporters(const Surface& surface, const std::vector<std::size_t>& open,
                                    const Plane& plane, double tolerance_m) {
  std::vector<std::size_t> found;
  for (const std::size_t idx : open) {
    const Patch& patch = surface.patches[idx];
    if (std::abs(plane.height_m(patch.center)) <= tolerance_m &&
        std::abs(dot(plane.normal, patch.normal)) >= kAgreeing)
      found.push_back(idx);
  }
  return found;
}

std::size_t samples_of(const Surface& surface, const std::vector<std::size_t>& patches) {
  std::size_t count = 0;
  for (const std::size_t idx : patches) count += surface.patches[idx].size();
  return count;
}

/// Samples of the patches within the tolerance of the plane, and the tolerance that their median distance
/// suggests: 3 sigma.
std::vector<Vec3> inliers_of(const Surface& surface, const SurfacePlane& found, double& tolerance_m) {
  std::vector<Vec3> inliers;
  std::vector<double> distances_m;
  for (const std::size_t idx : found.patches)
    for (std::size_t i = surface.patches[idx].begin; i < surface.patches[idx].end; ++i) {
      const double distance_m = std::abs(found.plane.height_m(surface.samples[i]));
      if (distance_m > tolerance_m) continue;
      inliers.push_back(surface.samples[i]);
      distances_m.push_back(distance_m);
    }
  if (inliers.empty()) return inliers;
  const auto median = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), median, distances_m.end());
  tolerance_m = std::clamp(3 * 1.4826 * *median, 0.1 * tolerance_m, tolerance_m);
  return inliers;
}

SurfacePlane refined(const Surface& surface, const std::vector<std::size_t>& open, Plane plane,
                     double tolerance_m) {
  SurfacePlane found{plane, {}, 0, 0};
  double inlier_tolerance_m = tolerance_m;
  for (int step = 0; step < kRefinements; ++step) {
    found.patches = supporters(surface, open, found.plane, tolerance_m);
    const std::vector<Vec3> inliers = inliers_of(surface, found, inlier_tolerance_m);
    if (inliers.size() < 3) break;
    const PlaneFit fit = fit_plane(inliers);
    found.plane = fit.plane;
    found.samples = inliers.size();
    found.rms_m = fit.rms_m;
  }
  double full_m = tolerance_m;
  found.samples = inliers_of(surface, found, full_m).size();
  return found;
}

}  // namespace

std::vector<SurfacePlane> find_planes(const Surface& surface, Vec3 axis, double cone_deg, double tolerance_m,
                                      double min_area_m2) {
  const double least_cosine = std::cos(cone_deg * std::numbers::pi / 180);
  std::vector<SurfacePlane> planes;
  std::vector<std::size_t> open(surface.patches.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
  while (planes.size() < kMostPlanes) {
    Plane best;
    std::size_t most = 0;
    const std::size_t stride = 1 + open.size() / kMostHypotheses;
    for (std::size_t i = 0; i < open.size(); i += stride) {
      const Patch& patch = surface.patches[open[i]];
      if (std::abs(dot(patch.normal, axis)) < least_cosine) continue;
      const Plane plane{patch.normal, -dot(patch.normal, patch.center)};
      const std::size_t count = samples_of(surface, supporters(surface, open, plane, tolerance_m));
      if (count > most) most = count, best = plane;
    }
    if (most == 0) break;
    SurfacePlane found = refined(surface, open, best, tolerance_m);
    if (Surface::area_m2(found.samples) < min_area_m2) break;
    std::erase_if(open, [&](std::size_t idx) {
      return std::abs(found.plane.height_m(surface.patches[idx].center)) <= 2 * tolerance_m &&
             std::abs(dot(found.plane.normal, surface.patches[idx].normal)) >= kAgreeing;
    });
    if (std::abs(dot(found.plane.normal, axis)) >= least_cosine) planes.push_back(std::move(found));
  }
  return planes;
}

}  // namespace sediment::project2d
