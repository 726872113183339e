#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gi/final_gather.h"

namespace prelight {

/// Casts more rays in the directions that photons came from (Jensen 1995). The irradiance is unbiased for any
/// guides.
class GuidedGather final : public GatherPattern {
 public:
  /// `guides`, [receiver][PRELIGHT_GUIDE_CELLS], are densities over the square of directions, with mean 1 and
  /// above 0 (DensityEstimator::guides). The arguments must outlive the object.
  GuidedGather(const FinalGather& gather, std::span<const float> guides, std::size_t receivers);

  void makeRays(const GatherBlock& block) override;
  void sum(const GatherBlock& block) override;

  /// Returns irradiance, W/m2, [receiver].
  const std::vector<glm::vec3>& irradiance() const { return irradiance_; }

 private:
  std::span<const float> guides_;
  std::vector<glm::vec3> irradiance_;
  Buffer<float> guideBuffer_, weights_, sums_;
  Kernel<Buffer<device::GatherParameters>, Buffer<device::Receiver>, Buffer<float>, Buffer<device::Ray>,
         Buffer<float>>
      generate_;
  Kernel<Buffer<device::GatherParameters>, Buffer<float>, Buffer<float>, Buffer<float>> sum_;
};

}  // namespace prelight
