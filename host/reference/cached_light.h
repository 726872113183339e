#pragma once

#include "gather/irradiance_map.h"
#include "photon/caustic_light.h"
#include "shade/transport_scene.h"

namespace prelight::reference {

/// Light computed beforehand, which paths of a camera find where they meet a surface instead of being
/// followed on. The referents outlive it.
struct CachedLight {
  const IrradianceMap* indirect = nullptr;  ///< of everything but direct light and caustics
  const CausticLight* caustics = nullptr;   ///< nullptr: there are none
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
