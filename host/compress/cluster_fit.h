#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/progress.h"

namespace prelight {

struct ClusterRequest {
  int clusters = 1;    ///< 1 gives principal component analysis
  int components = 0;  ///< 0 gives vector quantisation
  std::uint64_t seed = 1;
  int iterations = 40;
  const Progress* progress = nullptr;  ///< asked whether to stop, and keeps unfinished work
};

/// Vectors as points of affine subspaces: x[v] ~ means[k] + sum_j weights[v][j] basis[k][j] with k =
/// clusterOf[v].
struct ClusterFit {
  int clusters = 0;  ///< at most the number asked for and the number of vectors
  int components = 0;
  std::vector<double> means;             ///< [cluster][dimension]
  std::vector<double> basis;             ///< [cluster][component][dimension], orthonormal within a cluster
  std::vector<std::uint32_t> clusterOf;  ///< [vector]
  std::vector<double> weights;           ///< [vector][component]
  /// Weighted total after each iteration, which never rises while the number of components stays.
  std::vector<double> squaredErrors = {};
};

/// Clustered PCA (Sloan, Hall, Hart and Snyder 2003): vector quantisation from k-means++ seeds, then
/// components in doubling numbers, each with iterations of "assign to the cluster that reconstructs best" and
/// "fit mean and axes of every cluster". `vectors` is [vector][dimension]; `weights`, one per vector, >= 0,
/// scale squared errors. Ends when an iteration gains less than 1e-4. Requires at least one vector and
/// components <= dimension. Throws Interrupted.
ClusterFit fitClusters(std::span<const float> vectors, std::size_t dimension, std::span<const double> weights,
                       const ClusterRequest& request);

}  // namespace prelight
