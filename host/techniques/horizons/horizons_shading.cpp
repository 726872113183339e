#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

constexpr int defaultSectors = 8;

void checkHorizons(const Bake& bake, const CompiledScene& scene) {
  const auto& horizons = bake.horizons;
  if (!horizons) return;
  const std::size_t numbers = rowNumbers(scene.vertexCount(), horizons->sectors, 1, 0);
  requireCount("horizons", horizons->angles.size(), numbers);
  if (!horizons->feet.empty()) requireCount("feet of horizons", horizons->feet.size(), numbers);
}

}  // namespace

extern const ShadingInfo horizonsShading = {
    .shading = Shading::Horizons,
    .summary = "sky, lights and reflections above the horizons around a surface",
    .bakeOption = "horizons 8",
    .bakedName = "horizons",
    .rules = {{"horizons_ambient.glsl"}, Reflection::Everywhere, Through::None},
    .traits = {.skyLampsApart = true, .accessibility = true},
    .error = {.sky = 0.05f, .outside = 0.024f, .inside = 0.063f},
    .carriedBy = [](const Bake& bake) { return bake.horizons.has_value(); },
    .askedBy = [](const BakeRequest& request) { return request.horizons.sectors > 0; },
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          request.horizons = asked.horizons;
          request.horizons.sectors = orDefault(asked.horizons.sectors, defaultSectors);
        },
    .check = checkHorizons,
    .take = [](Bake& into, Bake& from) { takePart(into.horizons, from.horizons); },
};

}  // namespace prelight
