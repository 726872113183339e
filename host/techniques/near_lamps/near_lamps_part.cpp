#include "plan/cast_orders.h"
#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

void checkShells(const Bake& bake, const CompiledScene& scene) {
  const auto& lamps = bake.nearLamps;
  if (!lamps) return;
  requireDrawable("shells of near lamps", lamps->order, maxTransferOrder, 1);
  requireCount("shells of near lamps", lamps->halves.size(),
               rowNumbers(scene.vertexCount(), lamps->shells, lamps->order, 2));
}

}  // namespace

/// It comes with transfer that the far lights come through.
extern const BakedPart shellPart = {
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          if (nearLampOrder(request) > 0) request.nearLamps = asked.nearLamps;
        },
    .check = checkShells,
    .take = [](Bake& into, Bake& from) { takePart(into.nearLamps, from.nearLamps); },
};

}  // namespace prelight
