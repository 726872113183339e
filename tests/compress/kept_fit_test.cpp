#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "compress/cluster_fit.h"
#include "support/resumed.h"

namespace prelight {
namespace {

TEST(ClusterFit, StoppedAgainAndAgain_IsTheSame) {
  constexpr std::size_t dimension = 12, count = 600;
  std::mt19937 random(21);
  std::normal_distribution<float> normal;
  std::vector<float> points;
  for (std::size_t i = 0; i < count * dimension; ++i) points.push_back(normal(random));
  const std::vector<double> weights(count, 0.5);
  ClusterRequest request{.clusters = 6, .components = 5};
  const ClusterFit whole = fitClusters(points, dimension, weights, request);
  int runs = 0;
  const ClusterFit parts = test::inManyRuns([&](Progress& progress) {
    ++runs;
    request.progress = &progress;
    return fitClusters(points, dimension, weights, request);
  });
  EXPECT_GT(runs, 3);
  EXPECT_EQ(parts.means, whole.means);
  EXPECT_EQ(parts.basis, whole.basis);
  EXPECT_EQ(parts.clusterOf, whole.clusterOf);
  EXPECT_EQ(parts.weights, whole.weights);
  EXPECT_EQ(parts.squaredErrors, whole.squaredErrors);
}

}  // namespace
}  // namespace prelight
