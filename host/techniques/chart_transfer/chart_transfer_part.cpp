#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

void checkCharts(const Bake& bake, const CompiledScene& scene) {
  const auto& texels = bake.chartTransfer;
  if (!texels) return;
  requireDrawable("light maps", texels->order, maxTransferOrder, texels->channels);
  for (const ChartTransfer::Map& map : texels->maps) {
    requireCount("primitives with light maps", map.primitive < scene.primitives.size() ? 1 : 0, 1);
    requireCount("texture coordinates of light maps", map.coords.size(),
                 scene.primitives[map.primitive].vertexCount);
    requireCount(
        "light maps", map.coefficients.size(),
        static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) * texels->rowLength());
  }
}

}  // namespace

/// It comes with SH transfer.
extern const BakedPart chartPart = {
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          if (request.sh.order > 0) request.chartTransfer = asked.chartTransfer;
        },
    .check = checkCharts,
    .take = [](Bake& into, Bake& from) { takePart(into.chartTransfer, from.chartTransfer); },
};

}  // namespace prelight
