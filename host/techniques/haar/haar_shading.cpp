#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

constexpr int defaultHaarSize = 32;

void checkHaar(const Bake& bake, const CompiledScene& scene) {
  if (!bake.haar) return;
  requireCount("Haar transfer", bake.haar->offsets.size(),
               rowNumbers(scene.vertexCount(), bake.haar->channels, 1, 0) + 1);
}

}  // namespace

extern const ShadingInfo haarShading = {
    .shading = Shading::Haar,
    .summary = "light through wavelet transfer",
    .bakeOption = "haar 32",
    .bakedName = "wavelet transfer",
    .rules = throughTransfer,
    .traits = {.bounces = true, .relitOnDevice = true},
    .error = {.sky = 0.024f, .outside = 0.05f, .inside = 0.062f},
    .carriedBy = [](const Bake& bake) { return bake.haar.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.haar.size > 0; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.haar = asked.haar;
          request.haar.size = orDefault(asked.haar.size, defaultHaarSize);
        },
    .check = checkHaar,
    .take = [](Bake& into, Bake& from) { takePart(into.haar, from.haar); },
};

}  // namespace prelight
