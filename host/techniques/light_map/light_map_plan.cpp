#include "techniques/light_map/light_map_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "basis/incident_values.h"
#include "cast/schedule.h"
#include "charts/light_map_charts.h"
#include "charts/make_light_map_layout.h"
#include "encodings/encoding.h"
#include "gi/indirect_light.h"
#include "photon/photon_sources.h"
#include "scene/light_sources.h"
#include "techniques/light_map/light_map_light.h"

namespace prelight {

namespace {

constexpr std::uint64_t bytesPerTexel = 40;     // places, bitmaps
constexpr std::uint64_t bytesPerValue = 3 * 8;  // of all channels, and of a picture while it is written
constexpr std::uint64_t bytesPerTriangle = 200;
/// The smallest texels of sizes by error, of the size that is chosen without: sixteen times as many are the
/// most.
constexpr double finestShare = 0.25;

/// m2, fronts and backs.
double litArea(const CompiledScene& scene) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    const double area = 0.5 * glm::length(geometricNormal(scene, t));
    for (const bool back : {false, true})
      if (hasLight(material, back)) sum += area;
  }
  return sum;
}

/// At most, with sizes by error.
double texelCount(const CompiledScene& scene, const BakeRequest& request) {
  if (const double size = request.lightMap.texelSize; size > 0.0) {
    constexpr double most = 3.0 * mostLightMapSide * mostLightMapSide;
    const double texels = litArea(scene) / (size * size);
    if (texels > most) refuseTexelSize(size, 1.2 * size * std::sqrt(texels) / mostLightMapSide);
    return texels;
  }
  return request.lightMap.error > 0.0 ? fewestUsualTexels / (finestShare * finestShare)
                                      : usualTexels(scene).count;
}

/// "2.3 cm".
std::string lengthText(double metres) {
  return metres < 1.0 ? fmt::format("{:.2g} cm", 100.0 * metres) : fmt::format("{:.2g} m", metres);
}

std::string texelText(const CompiledScene& scene, const BakeRequest& request) {
  constexpr double usedShare = 0.85;  // of a map
  const double texels = texelCount(scene, request);
  if (request.lightMap.error > 0.0) return fmt::format("{:.0f} texels at most", texels);
  const double side = std::sqrt(texels / usedShare);
  const std::string map = fmt::format("a map of about {0:.0f} x {0:.0f}; {1} rays per texel", side,
                                      raysEach(withTexelEffort(scene, request)));
  if (request.lightMap.texelSize > 0.0)
    return fmt::format("texels of {:g} m, about {:.0f}, {}", request.lightMap.texelSize, texels, map);
  return fmt::format(
      "about {:.0f} texels of {}, by the area and the pieces of the surface, because no size is "
      "asked for, {}",
      texels, lengthText(std::sqrt(litArea(scene) / texels)), map);
}

PlannedPass planSizes(const BakeRequest& request) {
  constexpr Pass name = Pass::TexelSizes;
  if (!(request.lightMap.error > 0.0))
    return {name, false, "texels of one size are asked for (LightMapRequest::error)"};
  return {name, true,
          fmt::format("for each chart the largest with an interpolation error of {:g} %, found by pilots "
                      "with a quarter of the rays",
                      100.0 * request.lightMap.error)};
}

PlannedPass planDirect(const CompiledScene& scene) {
  if (!hasLights(scene))
    return {Pass::DirectLightOfTheMap, false, "the scene has no light and nothing emissive"};
  std::size_t emitters = 0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) emitters += emits(scene, t) ? 1 : 0;
  return {Pass::DirectLightOfTheMap, true,
          fmt::format("shadow rays from every texel to {} punctual lights{}", scene.lights.size(),
                      emitters > 0 ? fmt::format(" and {} emissive triangles", emitters)
                                   : ", of which one each is exact")};
}

PlannedPass planSky(const BakeRequest& request) {
  constexpr Pass name = Pass::SkyLightOfTheMap;
  if (!request.radiosity.environment) return {name, false, "there is no sky (RadiosityRequest::environment)"};
  if (shiningSky(request.radiosity.environment.get()) == nullptr) return {name, false, "the sky is black"};
  return {name, true, "rays by the cosine and by the sky's radiance from every texel"};
}

bool isLit(const CompiledScene& scene, const BakeRequest& request) {
  return hasLights(scene) || shiningSky(request.radiosity.environment.get()) != nullptr;
}

constexpr const char* unlit = "the scene has no light, nothing emissive and no sky that shines";

PlannedPass planIndirect(const CompiledScene& scene, const BakeRequest& request) {
  constexpr Pass name = Pass::IndirectLightOfTheMap;
  if (!isLit(scene, request)) return {name, false, unlit};
  return {name, true, "photons, their density in every texel, and a final gathering from it"};
}

PlannedPass planCaustics(const CompiledScene& scene, const BakeRequest& request) {
  constexpr Pass name = Pass::CausticsOfTheMap;
  if (!request.lightMap.caustics) return {name, false, "not asked for (LightMapRequest::caustics)"};
  if (!isLit(scene, request)) return {name, false, unlit};
  if (causticCasters(scene).empty()) return {name, false, "no surface is a mirror, glass or nearly a mirror"};
  return {name, true, "photons towards mirrors, glass and narrow lobes"};
}

PlannedPass planDirections(const CompiledScene& scene) {
  constexpr Pass name = Pass::DirectionsOfTheMap;
  std::vector<std::uint8_t> mapped(scene.materials.size(), 0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const std::uint32_t m = scene.triangleMaterials[t];
    if (scene.materials[m].normalTexture.image >= 0 &&
        (hasLight(scene.materials[m], false) || hasLight(scene.materials[m], true)))
      mapped[m] = 1;
  }
  const auto count = std::count(mapped.begin(), mapped.end(), 1);
  if (count == 0) return {name, false, "no lit surface has a normal map: irradiance is enough"};
  return {name, true,
          fmt::format("incident radiance in SH of order 2 beside irradiance, for the normal maps of {} {}",
                      count, count == 1 ? "material" : "materials")};
}

/// All passes of a light map, for one reason not run.
std::vector<PlannedPass> noLightMap(const char* map, const char* parts) {
  return {{Pass::LightMap, false, map},
          {Pass::TexelSizes, false, parts},
          {Pass::DirectLightOfTheMap, false, parts},
          {Pass::SkyLightOfTheMap, false, parts},
          {Pass::IndirectLightOfTheMap, false, parts},
          {Pass::CausticsOfTheMap, false, parts},
          {Pass::DirectionsOfTheMap, false, parts}};
}

}  // namespace

LightMapLayoutRequest lightMapRequest(const BakeRequest& request) {
  LightMapLayoutRequest layout;
  if (request.lightMap.error > 0.0)
    layout.texels = fewestUsualTexels;
  else
    layout.texelSize = request.lightMap.texelSize;
  return layout;
}

BakeRequest withTexelEffort(const CompiledScene& scene, BakeRequest request) {
  if (request.lightMap.texelSize > 0.0 || request.lightMap.error > 0.0) return request;
  const double texels = usualTexels(scene).count;
  if (texels <= fewestUsualTexels) return request;
  const double share = std::pow(fewestUsualTexels / texels, 2.0 / 3.0);
  const double rays =
      std::exp2(std::round(std::log2(share * raysEach(request))));  // the nearest power of two
  request.effort = {.rays = static_cast<std::uint64_t>(std::max(16.0, rays))};
  if (request.lightMap.photons == 0)
    request.lightMap.photons = usualPhotons(static_cast<std::size_t>(share * texels)) *
                               (request.lightMap.denoise ? photonsForFilters : 1);
  return request;
}

double finestTexel(const BakeRequest& request, const LightMapCharts& charts) {
  return request.lightMap.texelSize > 0.0 ? request.lightMap.texelSize : finestShare * charts.texelSize;
}

std::vector<PlannedPass> planLightMap(const CompiledScene& scene, const BakeRequest& request) {
  if (!request.lightMap) return noLightMap("not asked for", "no light map is asked for");
  if (!takesLight(scene)) {
    const char* reason = "no surface reflects diffusely, so none needs light";
    return noLightMap(reason, reason);
  }
  return {{Pass::LightMap, true,
           texelText(scene, request) + "; charts of surfaces without creases, seams stitched"},
          planSizes(request),
          planDirect(scene),
          planSky(request),
          planIndirect(scene, request),
          planCaustics(scene, request),
          planDirections(scene)};
}

bool takesLight(const CompiledScene& scene) { return litArea(scene) > 0.0; }

std::uint64_t mostTexels(const CompiledScene& scene, const BakeRequest& request) {
  return static_cast<std::uint64_t>(1.3 * texelCount(scene, request));
}

int lightMapCoefficients(const Plan& plan) {
  return plan.runs(Pass::EncodedLight) ? incidentValueCount(incidentOrder) : keptLightMapCoefficients(plan);
}

int keptLightMapCoefficients(const Plan& plan) {
  return plan.runs(Pass::DirectionsOfTheMap) ? incidentValueCount(leastIncidentOrder) : 1;
}

std::uint64_t lightMapBytes(const CompiledScene& scene, const BakeRequest& request, int coefficients) {
  return mostTexels(scene, request) *
             (bytesPerTexel + bytesPerValue * static_cast<std::uint64_t>(coefficients)) +
         scene.triangleCount() * bytesPerTriangle +
         (request.lightMap.denoise ? std::uint64_t{denoiserMegabytes} << 20 : 0);
}

}  // namespace prelight
