#include "gather/light_map_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bake/schedule.h"

namespace prelight {

namespace {

constexpr std::uint64_t leastPhotons = 50'000, mostPhotons = 2'000'000;
constexpr std::uint64_t photonsPerTexel = 4;

/// Gathering rays a texel: indirect light is smoother than what receivers see of it.
std::uint32_t gatherRays(const BakeRequest& request) { return std::max(16u, raysEach(request) / 4); }

double meanTexel(const CompiledScene& scene, const LightMapLayout& layout) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (layout.chartOf[t] != LightMapLayout::noChart) area += 0.5 * glm::length(geometricNormal(scene, t));
  return std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, layout.texels.size())));
}

}  // namespace

std::uint64_t usualPhotons(std::size_t texels) {
  return std::clamp<std::uint64_t>(photonsPerTexel * texels, leastPhotons, mostPhotons);
}

LightMapLight::LightMapLight(const CompiledScene& scene, const std::vector<Image>& images,
                             const LightMapLayout& layout, const BakeRequest& request, const Plan& plan,
                             const Device& device, Tracer& tracer, Progress& progress)
    : lit_{scene, images, scene.lights, request.radiosityShape.environment.get(),
           request.radiosityShape.skyRotation},
      transport_(lit_, tracer),
      surface_(makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle))) {
  if (plan.runs("indirect light of the map")) {
    IndirectRequest indirect;
    indirect.photons = request.photons > 0 ? request.photons : usualPhotons(layout.texels.size());
    indirect.rays = gatherRays(request);
    indirect.seed = request.seed;
    indirect_.emplace(lit_, transport_, layout, surface_, indirect, device, progress);
    indirectPart_.emplace(*indirect_, progress);
  }
  if (plan.runs("caustics of the map")) traceCaustics(scene, layout, request, device, progress);
}

void LightMapLight::traceCaustics(const CompiledScene& scene, const LightMapLayout& layout,
                                  const BakeRequest& request, const Device& device, Progress& progress) {
  const std::uint64_t photons = request.photons > 0 ? request.photons : usualPhotons(layout.texels.size());
  PhotonReport report;
  causticLight_ = traceCausticLight(scene, transport_, surface_, photons, request.seed + 1,
                                    meanTexel(scene, layout), device, progress, report);
  if (!causticLight_) return;
  causticPart_.emplace(scene, causticLight_->estimator, causticLight_->filter.radius, report.rays);
}

void LightMapLight::addTo(std::vector<LightMapPart*>& parts) {
  if (indirectPart_) parts.push_back(&*indirectPart_);
  if (causticPart_) parts.push_back(&*causticPart_);
}

}  // namespace prelight
