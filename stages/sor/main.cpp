#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/sor/outlier_filter.hpp"

using namespace sediment;
using namespace sediment::contract;

int main(int argc, char** argv) {
  sor::Parameters parameters;
  PcdEncoding encoding = PcdEncoding::binary;
  Stage stage("sor", "Removes points that lie unusually far from, or near to, their neighbours");
  stage.reads("cloud", kind::kCloud, "cloud to filter");
  stage.writes("cloud", kind::kCloud, "the same cloud without outliers");
  stage.tunes("neighbors", parameters.neighbors,
              "k of equation (9): neighbours of a point whose mean distance is taken, itself left out",
              {1, 100000});
  stage.tunes("sigmas", parameters.sigmas, "standard deviations around the mean that are kept (paper: 2.5)",
              {0, 1000});
  stage.tunes("rule", parameters.rule,
              "two-sided as in the paper, or one-sided as in PCL: only far points are outliers",
              {{"two-sided", sor::Rule::two_sided}, {"one-sided", sor::Rule::one_sided}});
  stage.tunes("encoding", encoding, "of cloud.pcd",
              {{"ascii", PcdEncoding::ascii},
               {"binary", PcdEncoding::binary},
               {"binary-compressed", PcdEncoding::binary_compressed}});
  return stage.run(argc, argv, [&](Work& work) {
    LabelledCloud cloud = read_cloud(work.in("cloud"));
    const sor::Statistics statistics = sor::remove_outliers(cloud, parameters);
    write_cloud(work.out(), cloud, read_cloud_labels(work.in("cloud")), encoding);
    work.metrics() = {{"points_read", statistics.points},
                      {"points_written", cloud.size()},
                      {"removed_not_finite", statistics.not_finite},
                      {"removed_too_far", statistics.too_far},
                      {"removed_too_near", statistics.too_near},
                      {"mean_distance_m", statistics.mean_m},
                      {"deviation_m", statistics.deviation_m},
                      {"lower_limit_m", statistics.lower_m},
                      {"upper_limit_m", statistics.upper_m}};
  });
}
