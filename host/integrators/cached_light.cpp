#include "integrators/cached_light.h"

#include <algorithm>
#include <cmath>

#include "photon/caustic_light.h"
#include "photon/photon_sources.h"
#include "scene/surface/surface_regions.h"

namespace prelight::reference {

namespace {

constexpr std::uint32_t causticSamples = 2;  // per pixel

}  // namespace

BuildOptions cachedLightOptions(const CachedLight& light, BuildOptions options) {
  if (light.caustics == nullptr) return options;
  return DensityEstimator::addOptions(options.define("PRELIGHT_CACHED_CAUSTICS"),
                                      light.caustics->filter.density);
}

void setCachedLight(const CachedLight& light, std::uint32_t samples,
                    device::CachedPathParameters& parameters) {
  parameters.indirect = light.indirect->layout();
  if (light.caustics == nullptr) return;
  parameters.caustics = light.caustics->estimator.parameters();
  parameters.causticRadius = static_cast<float>(light.caustics->filter.radius);
  parameters.causticSamples = std::min(samples, causticSamples);
}

namespace {

constexpr std::uint64_t leastPhotons = 65536, mostPhotons = 1u << 20;  ///< per pass
constexpr std::uint64_t pilotPhotons = 1u << 18;
constexpr int nearest = 10;          ///< approximate number of photons within the first radius
constexpr double alpha = 2.0 / 3.0;  ///< share of additional photons that is kept as passes accumulate

std::uint64_t seedOf(const ReferenceRequest& request, std::uint64_t pass) {
  return request.seed + 0x9e3779b97f4a7c15u * (pass + 1);
}

/// Returns the radius of a pass relative to that of the first.
double shrinkage(std::uint64_t pass) {
  // The square is the product of (i + alpha) / (i + 1) over the earlier passes, a quotient of gamma
  // functions.
  const double n = static_cast<double>(pass);
  const double square =
      std::lgamma(n + 1.0 + alpha) - std::lgamma(1.0 + alpha) - std::lgamma(n + 2.0) + std::lgamma(2.0);
  return std::exp(0.5 * square);
}

/// Returns the tables with punctual lights only; paths hit emitters and skies by chance.
LightTables punctualAlone(const LightTables& tables) {
  LightTables punctual;
  punctual.punctual = tables.punctual;
  punctual.punctualPowers = tables.punctualPowers;
  return punctual;
}

}  // namespace

bool CausticPasses::areNeeded(const TransportScene& scene, const CompiledScene& compiled,
                              const ReferenceRequest& request) {
  const bool follows =
      request.integrator == Integrator::Path || request.integrator == Integrator::Distributed;
  return follows && request.depth > 2 && scene.features().punctual && scene.features().scatters &&
         !sharpCasters(compiled).empty();
}

CausticPasses::CausticPasses(TransportScene& scene, const CompiledScene& compiled,
                             const ReferenceRequest& request, std::uint64_t pathsPerPass)
    : compiled_(compiled),
      scene_(scene),
      request_(request),
      photons_(std::clamp(pathsPerPass, leastPhotons, mostPhotons)),
      tracer_(compiled, scene),
      surface_(makeDensitySurface(compiled, makeSurfaceRegions(compiled, usualCreaseAngle))),
      estimator_(surface_, {}, scene.context()),
      parameters_(scene.context(), 1) {
  const PhotonHits hits = send(request.seed, pilotPhotons);
  if (hits.photons.empty()) return;
  const PhotonMaps maps = makePhotonMaps(hits.photons, surface_);
  const double density = static_cast<double>(pilotPhotons) / static_cast<double>(photons_);
  firstRadius_ = radiusOfNearest(maps, nearest) * std::sqrt(density);
}

/// Sends caustic photons. Their depth leaves at least one segment for the camera.
PhotonHits CausticPasses::send(std::uint64_t seed, std::uint64_t photons) {
  PhotonRequest request;
  request.kind = PhotonKind::Caustic;
  request.sharp = true;
  request.photons = photons;
  request.seed = seed;
  request.depth = request_.depth - 1;
  PhotonHits hits;
  Progress progress;
  const PhotonSources sources =
      sourcesTowards(compiled_, punctualAlone(scene_.lights()), sharpCasters(compiled_), photons, seed);
  rays_ += tracer_.trace(request, sources, hits, progress).rays;
  return hits;
}

void CausticPasses::make(std::uint64_t pass) {
  radius_ = static_cast<float>(firstRadius_ * shrinkage(pass));
  estimator_.setPhotons(makePhotonMaps(send(seedOf(request_, pass), photons_).photons, surface_));
  parameters_.write(std::span<const device::DensityParameters>(&estimator_.parameters(), 1));
}

}  // namespace prelight::reference
