#pragma once

#include "gi/irradiance_map.h"
#include "gpu/transport_scene.h"
#include "photon/caustic_light.h"
#include "shared/cached_light_types.h"

namespace prelight::reference {

/// Precomputed light that camera paths look up at surfaces instead of continuing. The referents must outlive
/// it.
struct CachedLight {
  const IrradianceMap* indirect = nullptr;  ///< everything but direct light and caustics
  const CausticLight* caustics = nullptr;   ///< nullptr: none
  /// Whether diffuse rays also look for lights; near lights, light sampling alone has no bound.
  bool meetsLights = false;
};

/// Returns the options of integrate/cached_path_kernels.cl, added to those of the paths.
BuildOptions cachedLightOptions(const CachedLight& light, BuildOptions options);

/// Sets all parameters but those of the paths. `samples` is the number of paths per pixel.
void setCachedLight(const CachedLight& light, std::uint32_t samples,
                    device::CachedPathParameters& parameters);

}  // namespace prelight::reference
