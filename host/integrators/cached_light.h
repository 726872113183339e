#pragma once

#include "gi/irradiance_map.h"
#include "gpu/transport_scene.h"
#include "photon/caustic_light.h"
#include "shared/cached_light_types.h"

namespace prelight::reference {

/// Light computed beforehand, which paths of a camera find where they meet a surface instead of being
/// followed on. The referents outlive it.
struct CachedLight {
  const IrradianceMap* indirect = nullptr;  ///< of everything but direct light and caustics
  const CausticLight* caustics = nullptr;   ///< nullptr: there are none
  bool meetsLights = false;  ///< diffuse rays look for lights as well: where these are near, samples of them
                             ///< alone have no bound
};

/// Options of a program of integrate/cached_path_kernels.cl, added to those of its paths.
BuildOptions cachedLightOptions(const CachedLight& light, BuildOptions options);

/// Sets all but the paths' own parameters. `samples`: paths a pixel.
void setCachedLight(const CachedLight& light, std::uint32_t samples,
                    device::CachedPathParameters& parameters);

}  // namespace prelight::reference
