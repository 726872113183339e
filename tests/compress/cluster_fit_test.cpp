#include "compress/cluster_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace prelight {
namespace {

constexpr std::size_t dimension = 12;

/// Orthonormal vectors [vector][dimension] by Gram-Schmidt.
std::vector<std::vector<double>> orthonormal(std::size_t count, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> vectors;
  while (vectors.size() < count) {
    std::vector<double> v(dimension);
    for (double& x : v) x = normal(random);
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& u : vectors) {
        double dot = 0.0;
        for (std::size_t i = 0; i < dimension; ++i) dot += u[i] * v[i];
        for (std::size_t i = 0; i < dimension; ++i) v[i] -= dot * u[i];
      }
    double length = 0.0;
    for (const double x : v) length += x * x;
    for (double& x : v) x /= std::sqrt(length);
    vectors.push_back(v);
  }
  return vectors;
}

/// Points of `planes` affine subspaces of dimension `flat`, far apart.
std::vector<float> pointsOfPlanes(std::size_t planes, std::size_t flat, std::size_t each, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<float> points;
  for (std::size_t p = 0; p < planes; ++p) {
    const auto axes = orthonormal(flat, random);
    std::vector<double> centre(dimension);
    for (double& x : centre) x = 30.0 * normal(random);
    for (std::size_t i = 0; i < each; ++i) {
      std::vector<double> point = centre;
      for (const auto& axis : axes) {
        const double along = normal(random);
        for (std::size_t d = 0; d < dimension; ++d) point[d] += along * axis[d];
      }
      points.insert(points.end(), point.begin(), point.end());
    }
  }
  return points;
}

double reconstructionError(const std::vector<float>& points, const ClusterFit& fit) {
  const auto k = static_cast<std::size_t>(fit.components);
  double sum = 0.0;
  for (std::size_t v = 0; v < fit.clusterOf.size(); ++v)
    for (std::size_t d = 0; d < dimension; ++d) {
      const std::size_t cluster = fit.clusterOf[v];
      double value = fit.means[cluster * dimension + d];
      for (std::size_t j = 0; j < k; ++j)
        value += fit.weights[v * k + j] * fit.basis[(cluster * k + j) * dimension + d];
      sum += (value - points[v * dimension + d]) * (value - points[v * dimension + d]);
    }
  return sum;
}

TEST(ClusterFit, OneCluster_KeepsTheAxesOfGreatestVariance) {
  std::mt19937 random(1);
  const auto axes = orthonormal(dimension, random);
  std::vector<float> points;
  // A pair of points on each axis: the variance along it is 2 s^2.
  for (std::size_t j = 0; j < dimension; ++j)
    for (const double sign : {-1.0, 1.0})
      for (std::size_t d = 0; d < dimension; ++d)
        points.push_back(static_cast<float>(5.0 + sign * double(j + 1) * axes[j][d]));
  for (int k = 1; k <= int(dimension); ++k) {
    const ClusterFit fit = fitClusters(points, dimension, {}, {.clusters = 1, .components = k});
    double left = 0.0;
    for (int j = 0; j < int(dimension) - k; ++j) left += 2.0 * (j + 1) * (j + 1);
    EXPECT_NEAR(reconstructionError(points, fit), left, 1e-9 + 1e-5 * left) << k << " components";
  }
}

TEST(ClusterFit, PointsOfPlanes_AreFoundExactly) {
  const auto points = pointsOfPlanes(5, 3, 60, 2);
  const ClusterFit fit = fitClusters(points, dimension, {}, {.clusters = 5, .components = 3});
  EXPECT_LT(reconstructionError(points, fit), 1e-6);
  const ClusterFit oneTooFew = fitClusters(points, dimension, {}, {.clusters = 5, .components = 2});
  EXPECT_GT(reconstructionError(points, oneTooFew), 100.0);
}

TEST(ClusterFit, Errors_NeverRiseWhileIterating) {
  const auto points = pointsOfPlanes(20, 6, 30, 3);
  const ClusterFit fit = fitClusters(points, dimension, {}, {.clusters = 7, .components = 4});
  ASSERT_GT(fit.squaredErrors.size(), 5u);
  for (std::size_t i = 1; i < fit.squaredErrors.size(); ++i)
    EXPECT_LE(fit.squaredErrors[i], fit.squaredErrors[i - 1] * (1.0 + 1e-9)) << "iteration " << i;
  EXPECT_LE(reconstructionError(points, fit), fit.squaredErrors.back() * (1.0 + 1e-6));
}

TEST(ClusterFit, VectorQuantisation_IsAFixedPointOfLloyd) {
  const auto points = pointsOfPlanes(6, 2, 50, 4);
  const ClusterFit fit =
      fitClusters(points, dimension, {}, {.clusters = 6, .components = 0, .iterations = 200});
  for (std::size_t v = 0; v < fit.clusterOf.size(); ++v) {
    std::size_t nearest = 0;
    double least = 1e300;
    for (std::size_t k = 0; k < 6; ++k) {
      double distance = 0.0;
      for (std::size_t d = 0; d < dimension; ++d)
        distance += std::pow(points[v * dimension + d] - fit.means[k * dimension + d], 2);
      if (distance < least) {
        least = distance;
        nearest = k;
      }
    }
    EXPECT_EQ(fit.clusterOf[v], nearest) << v;
  }
}

TEST(ClusterFit, SameSeed_GivesTheSameAndWeightsCount) {
  const auto points = pointsOfPlanes(9, 4, 40, 5);
  const ClusterRequest request{.clusters = 4, .components = 2, .seed = 7};
  const ClusterFit once = fitClusters(points, dimension, {}, request);
  const ClusterFit again = fitClusters(points, dimension, {}, request);
  EXPECT_EQ(once.means, again.means);
  EXPECT_EQ(once.basis, again.basis);
  EXPECT_EQ(once.clusterOf, again.clusterOf);

  // Only the first plane's vectors have weight: its error must be almost 0, whatever the error of the others.
  std::vector<double> weights(9 * 40, 0.0);
  std::fill_n(weights.begin(), 40, 1.0);
  const ClusterFit first = fitClusters(points, dimension, weights, {.clusters = 1, .components = 4});
  const std::vector<float> plane(points.begin(), points.begin() + 40 * dimension);
  ClusterFit part = first;
  part.clusterOf.resize(40);
  EXPECT_LT(reconstructionError(plane, part), 1e-6);
}

TEST(ClusterFit, MoreClustersThanVectors_MakesAsManyAsVectors) {
  const auto points = pointsOfPlanes(1, 2, 5, 6);
  const ClusterFit fit = fitClusters(points, dimension, {}, {.clusters = 50, .components = 0});
  EXPECT_EQ(fit.clusters, 5);
  EXPECT_LT(reconstructionError(points, fit), 1e-9);
}

TEST(ClusterFit, EqualVectors_AreNoProblem) {
  const std::vector<float> points(dimension * 10, 0.25f);
  const ClusterFit fit = fitClusters(points, dimension, {}, {.clusters = 3, .components = 2});
  EXPECT_LT(reconstructionError(points, fit), 1e-12);
  for (const double weight : fit.weights) EXPECT_TRUE(std::isfinite(weight));
}

}  // namespace
}  // namespace prelight
