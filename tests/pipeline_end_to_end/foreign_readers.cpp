// Opens the results of a run with the readers that others use: PCL's for clouds, OctoMap's for octrees, and a
// loader like map_server's for the grid. Prints what they found; exit code 1 with a message if one of them
// does not take it.
//
//   foreign_readers DIR      the --out DIR of a run
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <pcl/common/point_tests.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "tests/pipeline_end_to_end/map_server_loader.hpp"

namespace {

void expect(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

std::size_t read_cloud(const std::filesystem::path& file) {
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  expect(pcl::io::loadPCDFile(file.string(), cloud) == 0, file.string() + ": PCL cannot read it");
  expect(!cloud.empty(), file.string() + ": no point");
  expect(std::all_of(cloud.begin(), cloud.end(), [](const auto& point) { return pcl::isXYZFinite(point); }),
         file.string() + ": a point is not finite");
  expect(std::any_of(cloud.begin(), cloud.end(), [](const auto& point) { return point.label != 255; }),
         file.string() + ": no point has a label");
  expect(
      std::any_of(cloud.begin(), cloud.end(), [](const auto& point) { return (point.rgba & 0xffffff) != 0; }),
      file.string() + ": all points are black");
  std::cout << file.string() << ": " << cloud.size() << " points\n";
  return cloud.size();
}

template <class Tree>
std::size_t occupied_leaves(const Tree& tree) {
  std::size_t count = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    if (tree.isNodeOccupied(*leaf)) ++count;
  return count;
}

void read_octree(const std::filesystem::path& folder) {
  const std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(folder / "map.ot"));
  const auto* colored = dynamic_cast<octomap::ColorOcTree*>(any.get());
  expect(colored != nullptr, (folder / "map.ot").string() + ": OctoMap reads no ColorOcTree from it");
  octomap::OcTree plain(0.1);
  expect(plain.readBinary((folder / "map.bt").string()),
         (folder / "map.bt").string() + ": OctoMap cannot read it");
  expect(plain.getResolution() == colored->getResolution(), folder.string() + ": resolutions differ");
  const std::size_t leaves = occupied_leaves(*colored);
  expect(leaves > 0, folder.string() + ": no occupied leaf");
  plain.expand();  // .bt merges equal neighbours, where colours keep them apart
  octomap::ColorOcTree finest(*colored);
  finest.expand();
  expect(occupied_leaves(plain) == occupied_leaves(finest), folder.string() + ": map.ot and map.bt differ");
  std::cout << folder.string() << ": " << leaves << " occupied leaves\n";
}

void read_grid(const std::filesystem::path& yaml) {
  const auto map = sediment::test::load_map(yaml);
  expect(map.occupied > 0, yaml.string() + ": no occupied cell");
  expect(map.free > 0, yaml.string() + ": no free cell");
  std::cout << yaml.string() << ": " << map.width << " x " << map.height << " cells, " << map.occupied
            << " occupied, " << map.free << " free, " << map.unknown << " unknown\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path out = argv[1];
  try {
    const std::size_t fused = read_cloud(out / "fuse/cloud.pcd");
    const std::size_t kept = read_cloud(out / "sor/cloud.pcd");
    const std::size_t voxels = read_cloud(out / "voxel/cloud.pcd");
    expect(fused >= kept && kept >= voxels, "the clouds do not shrink from stage to stage");
    read_octree(out / "octree");
    read_grid(out / "project2d/map.yaml");
  } catch (const std::exception& error) {
    std::cerr << "foreign_readers: " << error.what() << '\n';
    return 1;
  }
}
