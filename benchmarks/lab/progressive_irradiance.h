#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "photon/density_estimator.h"

namespace prelight {

/// Irradiance from pass after pass of photons, with radii that shrink so slowly that neither bias nor noise
/// is left in the end (Knaus and Zwicker 2011): after pass i the squared radius shrinks by (i + alpha) /
/// (i + 1). The mean squared error falls with the number of passes N as N^(-2/3) at the alpha that is best,
/// 2/3 (Kaplanyan and Dachsbacher 2013); at an edge or a crease, where the surface lies on one side of the
/// point alone, bias is of first order in the radius and the error falls as N^(-1/3) in the end.
class ProgressiveIrradiance {
 public:
  /// Queries carry the radii of the first pass. alpha: 0 (radii shrink fast, noise stays) to 1 (they stay).
  /// Throws UsageError for one out of range.
  explicit ProgressiveIrradiance(std::vector<device::DensityQuery> queries, double alpha = 2.0 / 3.0);

  /// Adds a pass whose photons together carry the power of all light. `estimator` should take all photons
  /// within the radius.
  void addPass(const PhotonMaps& photons, DensityEstimator& estimator);

  /// The next pass's radius over the first's.
  double radiusShare() const;

  /// W/m2, [query]; 0 before the first pass.
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
