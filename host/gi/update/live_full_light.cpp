#include "gi/update/live_full_light.h"

namespace prelight {

FullLight fullLightOf(const LiveLight& live) {
  FullLight full;
  full.indirect.layout = live.layout();
  full.indirect.values.assign(3 * live.layout().texelCount(), 0.0f);
  if (live.photons() != nullptr) setIrradiance(live.indirect(), full.indirect);
  full.plan = live.plan();
  full.photons = live.caustics();
  if (!full.photons.empty()) {
    const CompiledScene& scene = live.scene().compiled();
    const DensitySurface surface = makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle));
    full.filter = chooseCausticFilter(makePhotonMaps(full.photons, surface));
  }
  return full;
}

}  // namespace prelight
