#include "tools/tabulate/map_sizes.hpp"

#include "tools/tabulate/table.hpp"

namespace sediment::tabulate {
namespace {

std::string density_of(const nlohmann::json& fuse) {
  const std::string frames = fuse.at("frames");
  return frames == "every_nth" ? "every " + fuse.at("every_nth").dump() + "th frame"
         : frames == "all"     ? "all frames"
                               : frames;
}

std::string settings_of(const StageFacts& fuse, const StageFacts& sor, const StageFacts& voxel) {
  return formatted(
      "%s, depth %g to %g m, one pixel in %g of each row and column; sor.neighbors %g, %g sigma, %s; PCD %s, "
      "%g bytes a point",
      density_of(fuse.params).c_str(), fuse.params.at("min_depth_m").get<double>(),
      fuse.params.at("max_depth_m").get<double>(), fuse.params.at("pixel_step").get<double>(),
      sor.params.at("neighbors").get<double>(), sor.params.at("sigmas").get<double>(),
      sor.params.at("rule").get<std::string>().c_str(),
      voxel.params.at("encoding").get<std::string>().c_str(),
      static_cast<double>(fuse.files.at("cloud.pcd") / fuse.metrics.at("points").get<std::uint64_t>()));
}

MapSizes sizes_of(const InstanceFacts& instance) {
  const StageFacts &fuse = instance.stages.at("fuse"), &sor = instance.stages.at("sor"),
                   &voxel = instance.stages.at("voxel"), &octree = instance.stages.at("octree");
  const auto bytes = [](const StageFacts& stage, const char* file) {
    return static_cast<double>(stage.files.at(file));
  };
  MapSizes sizes;
  sizes.sequence = instance.values.contains("sequence") ? instance.values.at("sequence")
                                                        : instance.sequence.stem().string();
  sizes.density = density_of(fuse.params);
  sizes.leaf_m = voxel.params.at("leaf");
  sizes.resolution_m = octree.params.at("resolution_m");
  sizes.dense = bytes(fuse, "cloud.pcd");
  sizes.after_sor = bytes(sor, "cloud.pcd");
  sizes.after_voxel = bytes(voxel, "cloud.pcd");
  sizes.tree = bytes(octree, "map.ot");
  sizes.tree_binary = bytes(octree, "map.bt");
  sizes.dense_points = fuse.metrics.at("points");
  sizes.sor_points = sor.metrics.at("points_written");
  sizes.voxel_points = voxel.metrics.at("points_written");
  sizes.leaves = octree.metrics.at("leaves");
  sizes.frames_fused = fuse.metrics.at("frames_fused");
  sizes.settings = settings_of(fuse, sor, voxel);
  for (const StageFacts* stage : {&fuse, &sor, &voxel, &octree})
    sizes.receipts += (sizes.receipts.empty() ? "" : " ") + stage->short_key();
  return sizes;
}

}  // namespace

std::vector<MapSizes> map_sizes(std::span<const RunFacts> facts) {
  std::vector<MapSizes> all;
  for (const RunFacts& run : facts)
    for (const InstanceFacts& instance : run.instances) {
      bool whole = true;
      for (const char* stage : {"fuse", "sor", "voxel", "octree"})
        whole = whole && instance.stages.contains(stage);
      if (whole && instance.stages.at("fuse").metrics.at("points").get<double>() > 0)
        all.push_back(sizes_of(instance));
    }
  return all;
}

}  // namespace sediment::tabulate
