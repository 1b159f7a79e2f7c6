#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/voxel/voxel_filter.hpp"

using namespace sediment;
using namespace sediment::contract;

int main(int argc, char** argv) {
  voxel::Parameters parameters;
  PcdEncoding encoding = PcdEncoding::binary;
  Stage stage("voxel", "One point for each non-empty voxel: centroid, mean colour, majority label");
  stage.reads("cloud", kind::kCloud, "cloud to thin out");
  stage.writes("cloud", kind::kCloud, "one point per voxel, sorted by voxel");
  stage.tunes("leaf", parameters.leaf, "side of a voxel, metres", {1e-6, 1e6});
  stage.tunes("min_points", parameters.min_points, "voxels with fewer points are dropped", {1, 1000000});
  stage.tunes("encoding", encoding, "of cloud.pcd",
              {{"ascii", PcdEncoding::ascii},
               {"binary", PcdEncoding::binary},
               {"binary-compressed", PcdEncoding::binary_compressed}});
  return stage.run(argc, argv, [&](Work& work) {
    const LabelledCloud cloud = read_cloud(work.in("cloud"));
    voxel::Statistics statistics;
    const LabelledCloud merged = voxel::filter(cloud, parameters, statistics);
    write_cloud(work.out(), merged, read_cloud_labels(work.in("cloud")), encoding);
    work.metrics() = {{"points_read", statistics.points},
                      {"points_written", merged.size()},
                      {"points_not_finite", statistics.not_finite},
                      {"voxels", statistics.voxels},
                      {"voxels_too_sparse", statistics.too_sparse}};
  });
}
