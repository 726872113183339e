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

std::size_t bytesOfKey(const Bake& bake, const BakeRequest& request, std::size_t vertices) {
  const int order = bake.sh             ? bake.sh->order
                    : bake.compressedSh ? bake.compressedSh->order
                                        : request.sh.order;
  const int channels = bake.sh             ? bake.sh->channels
                       : bake.compressedSh ? bake.compressedSh->channels
                                           : (request.bounces > 0 ? 3 : 1);
  return vertices * static_cast<std::size_t>(channels * order * order) * sizeof(float);
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
