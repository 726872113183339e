#pragma once

#include "gather/irradiance_map.h"
#include "photon/density_estimator.h"
#include "shade/transport_scene.h"

namespace prelight::reference {

/// Light computed beforehand, which paths of a camera find where they meet a surface instead of being
/// followed on. The referents outlive it.
struct CachedLight {
  const IrradianceMap* indirect = nullptr;     ///< of everything but direct light and caustics
  const DensityEstimator* caustics = nullptr;  ///< with its photons; nullptr: there are none
  DensityOptions causticOptions;               ///< of the estimator
  double causticRadius = 0.0;                  ///< m, the largest of an estimate
  bool meetsLights = false;  ///< diffuse rays look for lights as well: where these are near, samples of them
                             ///< alone have no bound
};

/// Adds cached light to the paths of a block.
class CachedLightAdder {
 public:
  /// `samples`: paths a pixel.
  CachedLightAdder(TransportScene& scene, const CompiledScene& compiled, const CachedLight& light,
                   std::uint32_t samples);

  void add(std::uint32_t count, const Buffer<device::Ray>& rays, const Buffer<device::Hit>& hits,
           const Buffer<std::uint32_t>& queue, const cl::Buffer& paths);

 private:
  TransportScene& scene_;
  cl::Kernel add_;
};

}  // namespace prelight::reference
