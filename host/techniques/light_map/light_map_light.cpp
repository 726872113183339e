#include "techniques/light_map/light_map_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cast/schedule.h"
#include "charts/light_map_charts.h"
#include "charts/light_map_lookup.h"
#include "charts/wall_search.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

/// Gathering rays a texel: indirect light is smoother than what receivers see of it.
std::uint32_t gatherRays(const BakeRequest& request) { return std::max(16u, raysEach(request) / 4); }

/// Where errors are asked for, few texels are no reason for few photons.
std::uint64_t photonsOf(const BakeRequest& request, const LightMapLayout& layout) {
  if (request.lightMap.photons > 0) return request.lightMap.photons;
  const std::size_t texels = layout.texels.size();
  return usualPhotons(request.lightMap.error > 0.0 ? std::max<std::size_t>(texels, fewestUsualTexels)
                                                   : texels);
}

/// The side of the smallest texels of any chart, m. Charts of a few texels are rounded too far to tell.
double smallestTexel(const CompiledScene& scene, const LightMapLayout& layout) {
  constexpr double leastTexels = 4.0;
  std::vector<double> areas(layout.chartCount, 0.0), texels(layout.chartCount, 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    if (layout.chartOf[t] == LightMapLayout::noChart) continue;
    areas[layout.chartOf[t]] += 0.5 * glm::length(geometricNormal(scene, t));
    texels[layout.chartOf[t]] += texelsOf(layout, t);
  }
  double least = 0.0;
  for (std::size_t c = 0; c < areas.size(); ++c) {
    if (texels[c] < leastTexels) continue;
    const double size = std::sqrt(areas[c] / texels[c]);
    if (least == 0.0 || size < least) least = size;
  }
  return least;
}

bool meets(std::span<const std::uint8_t> backs) {
  return std::any_of(backs.begin(), backs.end(), [](std::uint8_t met) { return met != 0; });
}

/// A layout with texels below the map's for backs of one-sided surfaces that photons met: they send light
/// on, too.
LightMapLayout withBacks(const Scene& source, Tracer& tracer, const CompiledScene& scene,
                         LightMapLayout layout, std::span<const std::uint8_t> metBacks) {
  LightMapLayoutRequest request;
  request.texels = static_cast<std::uint32_t>(std::max<std::size_t>(1, layout.texels.size()));
  layout.walls.clear();
  addBacks(scene, makeLightMapCharts(source, scene, request), metBacks, layout);
  findWalls(scene, tracer, layout);
  return layout;
}

}  // namespace

LightMapLight::LightMapLight(const Scene& source, const CompiledScene& scene, const LightMapLayout& layout,
                             const BakeRequest& request, const Plan& plan, const Device& device,
                             Tracer& tracer, Progress& progress)
    : lit_{scene, source.images, scene.lights, shiningSky(request.radiosity.environment.get()),
           request.radiosity.skyRotation},
      transport_(lit_, tracer),
      surface_(makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle))),
      patches_(scene, tracer, layout, surface_) {
  if (plan.runs(Pass::IndirectLightOfTheMap)) {
    IndirectRequest indirect;
    const bool filtered = request.lightMap.denoise && request.lightMap.photons == 0;
    indirect.photons = photonsOf(request, layout) * (filtered ? photonsForFilters : 1);
    indirect.rays = gatherRays(request);
    indirect.seed = request.seed;
    const SentPhotons sent = sendPhotons(scene, transport_, indirectPhotons(transport_, indirect), progress);
    if (meets(sent.hits.backs))
      withBacks_.emplace(scene, tracer, withBacks(source, tracer, scene, layout, sent.hits.backs), surface_);
    indirect_.emplace(lit_, transport_, withBacks_ ? *withBacks_ : patches_, surface_, indirect, device, sent,
                      progress);
    indirectPart_.emplace(*indirect_, progress);
  }
  if (plan.runs(Pass::CausticsOfTheMap)) traceCaustics(scene, layout, request, device, progress);
}

void LightMapLight::traceCaustics(const CompiledScene& scene, const LightMapLayout& layout,
                                  const BakeRequest& request, const Device& device, Progress& progress) {
  const SentPhotons sent =
      sendPhotons(scene, transport_, causticRequest(photonsOf(request, layout), request.seed + 1), progress);
  const CausticMap map = makeCausticMap(patches_.sort(sent.hits.photons), smallestTexel(scene, layout));
  causticLight_ = makeCausticLight(map, surface_, device);
  if (!causticLight_) return;
  causticPart_.emplace(scene, patches_, causticLight_->estimator, map.filter.radius, sent.report.rays);
}

void LightMapLight::addTo(std::vector<LightMapPart*>& parts) {
  if (indirectPart_) parts.push_back(&*indirectPart_);
  if (causticPart_) parts.push_back(&*causticPart_);
}

}  // namespace prelight
