#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

constexpr int defaultOrderOfCh = 3;

}  // namespace

extern const ShadingInfo chShading = {
    .shading = Shading::Ch,
    .summary = "light through cpherical-harmonic transfer",
    .bakeOption = "ch 3",
    .bakedName = "CH transfer",
    .rules = throughTransfer,
    .traits = {.bounces = true, .skyLampsApart = true},
    .error = {.sky = 0.022f, .outside = 0.081f, .inside = 0.061f},
    .carriedBy = [](const Bake& bake) { return bake.ch.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.ch.order > 0; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.ch = asked.ch;
          request.ch.order = orDefault(asked.ch.order, defaultOrderOfCh);
        },
    .check =
        [](const Bake& bake, const CompiledScene& scene) {
          if (bake.ch) requireHarmonics("CH transfer", *bake.ch, scene);
        },
    .take = [](Bake& into, Bake& from) { takePart(into.ch, from.ch); },
};

}  // namespace prelight
