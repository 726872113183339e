#include "techniques/registry/keyed_bake.h"

#include "techniques/near_lamps/posed_shells.h"
#include "techniques/sh/animated_transfer.h"
#include "techniques/sh/bent_transfer.h"

namespace prelight {

Bake bakeAt(const AnimatedTransfer& keys, const Scene& scene, const CompiledScene& compiled, double seconds) {
  Bake bake;
  bake.sh = transferAt(keys, scene, compiled, seconds);
  bake.nearLamps = nearLampsAt(keys, scene, compiled, seconds);
  return bake;
}

BentBake::BentBake(const Bake& bake, const CompiledScene& compiled) {
  parts_.sh = bake.compressedSh && !bake.sh ? decompress(*bake.compressedSh) : bake.sh;
  parts_.nearLamps = bake.nearLamps;
  pose_.positions = compiled.positions;
  pose_.normals = compiled.normals;
  pose_.triangles = compiled.triangles;
}

bool BentBake::servesFor(const Bake& bake) { return bake.sh || bake.compressedSh; }

Bake BentBake::at(const CompiledScene& posed) const {
  const SurfaceBend bend = bendBetween(pose_, posed);
  Bake bake;
  if (parts_.sh) bake.sh = bentTransfer(*parts_.sh, bend);
  if (parts_.nearLamps) bake.nearLamps = bentNearLamps(*parts_.nearLamps, bend);
  return bake;
}

}  // namespace prelight
