#include "techniques/registry/keyed_bake.h"

#include "techniques/near_lamps/posed_shells.h"
#include "techniques/sh/animated_transfer.h"

namespace prelight {

Bake bakeAt(const AnimatedTransfer& keys, const Scene& scene, const CompiledScene& compiled, double seconds) {
  Bake bake;
  bake.sh = transferAt(keys, scene, compiled, seconds);
  bake.nearLamps = nearLampsAt(keys, scene, compiled, seconds);
  return bake;
}

}  // namespace prelight
