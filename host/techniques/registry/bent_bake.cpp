#include "techniques/registry/bent_bake.h"

#include "techniques/near_lamps/posed_shells.h"
#include "techniques/sh/bent_transfer.h"

namespace prelight {

BentBake::BentBake(const Bake& bake, const CompiledScene& compiled)
    : sh_(bake.sh), nearLamps_(bake.nearLamps) {
  if (!sh_ && bake.compressedSh) sh_ = decompress(*bake.compressedSh);
  pose_.positions = compiled.positions;
  pose_.normals = compiled.normals;
  pose_.triangles = compiled.triangles;
}

Bake BentBake::at(const CompiledScene& posed) const {
  const SurfaceBend bend = bendBetween(pose_, posed);
  Bake bake;
  if (sh_) bake.sh = bentTransfer(*sh_, bend);
  if (nearLamps_) bake.nearLamps = bentNearLamps(*nearLamps_, bend);
  return bake;
}

}  // namespace prelight
