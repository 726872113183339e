#include <algorithm>
#include <numeric>

#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

void checkAo(const Bake& bake, const CompiledScene& scene) {
  const std::uint32_t vertices = scene.vertexCount();
  if (!bake.ao.empty()) requireCount("ambient occlusion", bake.ao.size(), vertices);
  if (!bake.bentNormals.empty()) requireCount("bent normals", bake.bentNormals.size(), vertices);
}

void takeAo(Bake& into, Bake& from) {
  if (from.ao.empty()) return;
  into.ao = std::move(from.ao);
  into.bentNormals = std::move(from.bentNormals);
  into.apertures = std::move(from.apertures);
}

double opennessOfAo(const Bake& bake) {
  const double sum = std::accumulate(bake.ao.begin(), bake.ao.end(), 0.0);
  return std::clamp(sum / static_cast<double>(bake.ao.size()), 0.0, 1.0);
}

}  // namespace

extern const ShadingInfo aoShading = {
    .shading = Shading::Ao,
    .summary = "direct light without shadows, with the sky's light occluded",
    .bakeOption = "ao",
    .bakedName = "ambient occlusion",
    .rules = {{"accessible_ambient.glsl"}, Reflection::Everywhere, Through::None},
    .traits = {.bakedForWindows = true,
               .skyLampsApart = true,
               .accessibility = true,
               .tellsOpenSky = true,
               .creaseCorrection = true},
    .error = {.sky = 0.07f, .outside = 0.024f, .inside = 0.066f},
    .carriedBy = [](const Bake& bake) { return !bake.ao.empty() && !bake.bentNormals.empty(); },
    .askedBy = [](const BakeRequest& request) { return request.ao; },
    .addTo = [](BakeRequest& request, const BakeRequest&) { request.ao = true; },
    .check = checkAo,
    .take = takeAo,
    .openness = opennessOfAo,
};

}  // namespace prelight
