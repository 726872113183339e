#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

constexpr int defaultGlossyOrder = 4;

void checkGlossy(const Bake& bake, const CompiledScene& scene) {
  const auto& glossy = bake.glossy;
  if (!glossy) return;
  requireDrawable("glossy transfer", glossy->order, BakeRequest::maxGlossyOrder, glossy->channels);
  requireCount("glossy transfer", glossy->matrices.size(),
               rowNumbers(scene.vertexCount(), glossy->channels, glossy->order, 4));
}

}  // namespace

extern const ShadingInfo glossyShading = {
    .shading = Shading::Glossy,
    .summary = "diffuse and glossy reflection through transfer matrices",
    .bakeOption = "glossy 4",
    .bakedName = "glossy transfer",
    .rules = {Ambient::Transferred, Reflection::Transfer, Through::FarLights},
    .traits = {.bounces = true, .skyLampsApart = true, .relitOnDevice = true},
    .error = {.sky = 0.021f, .outside = 0.05f, .inside = 0.06f},
    .carriedBy = [](const Bake& bake) { return bake.glossy.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.glossy.order > 0; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.glossy = asked.glossy;
          request.glossy.order = orDefault(asked.glossy.order, defaultGlossyOrder);
        },
    .check = checkGlossy,
    .take = [](Bake& into, Bake& from) { takePart(into.glossy, from.glossy); },
};

}  // namespace prelight
