#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "photon/density_estimator.h"

namespace prelight {

/// Irradiance from successive passes of photons whose radii shrink so slowly that both bias and noise vanish
/// in the limit (Knaus and Zwicker 2011): after pass i the squared radius shrinks by (i + alpha) / (i + 1).
/// With N passes the mean squared error falls as N^(-2/3) for the best alpha, 2/3 (Kaplanyan and Dachsbacher
/// 2013). At edges and creases, where the surface lies on one side of the point only, bias is of first order
/// in the radius and the error finally falls as N^(-1/3).
class ProgressiveIrradiance {
 public:
  /// Queries hold the radii of the first pass. `alpha`: from 0 (radii shrink fast, noise remains) to 1 (radii
  /// stay). Throws UsageError outside this range.
  explicit ProgressiveIrradiance(std::vector<device::DensityQuery> queries, double alpha = 2.0 / 3.0);

  /// Adds a pass whose photons together carry the power of all light. `estimator` should use all photons
  /// within the radius.
  void addPass(const PhotonMaps& photons, DensityEstimator& estimator);

  /// Returns the radius of the next pass as a share of the first.
  double radiusShare() const;

  /// Returns [query] irradiance, W/m2; 0 before the first pass.
  std::vector<glm::vec3> irradiance() const;

 private:
  std::vector<device::DensityQuery> queries_;
  std::vector<float> firstRadii_;
  std::vector<glm::dvec3> sums_;
  double alpha_;
  double squaredShare_ = 1.0;
  int passes_ = 0;
};

}  // namespace prelight
