#include "gi/indirect_light.h"

#include <algorithm>
#include <cmath>

#include "base/clocks.h"
#include "base/colour.h"
#include "base/kept_work.h"
#include "base/work_share.h"
#include "charts/hidden_light.h"
#include "charts/irradiance/small_regions.h"
#include "charts/irradiance/spread_excess.h"
#include "gi/final_gather.h"
#include "gi/irradiance_cache.h"
#include "photon/density_estimator.h"
#include "radiosity/direct_light.h"

namespace prelight {

namespace {

/// Largest radius of density estimates, as a share of half the scene's diagonal.
constexpr double widestShare = 0.25;

/// Least reach of cache records, in texels; details below a texel are not visible in the map.
constexpr double leastReach = 1.5;

std::uint32_t raysPerReceiver(const IndirectRequest& request) {
  return std::min(request.rays, GatherRequest::mostRaysPerReceiver);
}

/// A place has several receivers where it has more rays than a receiver may have.
std::uint32_t receiversPerPlace(const IndirectRequest& request) {
  return std::max(1u, request.rays / raysPerReceiver(request));
}

// Queries between two checks whether to stop.
constexpr std::size_t leastQueries = 1u << 10, mostQueries = 1u << 18;

/// Returns the irradiance that photon densities give, W/m2, at the texels of a map (Larsen 2004, ch. 10).
std::vector<glm::vec3> irradianceOfPhotons(const CompiledScene& compiled, const SurfacePatches& patches,
                                           const DensitySurface& surface, const PhotonHits& hits,
                                           int nearestPhotons, const Device& device,
                                           const Progress& progress) {
  const std::vector<LightMapTexel>& places = patches.layout().texels;
  std::vector<glm::vec3> irradiance;
  WorkPart part(progress, "density", [&](auto& state) {
    state.growing(irradiance);
    state.require(irradiance.size() <= places.size());
    state.requireFinite(numbersOf(irradiance));
  });
  if (part.finished()) return irradiance;
  DensityOptions options;
  options.nearest = nearestPhotons;
  DensityEstimator estimator(surface, options, device);
  estimator.setPhotons(patches.sort(hits.photons));
  const std::vector<device::DensityQuery> queries =
      densityQueries(compiled, places, widestEstimate(compiled), patches.at(places));
  SharedLoop loop(part, "densities of photons");
  Pace pace(leastQueries, mostQueries);
  const std::size_t piece = SharedLoop::pieceSize(queries.size(), leastQueries, mostQueries);
  while (irradiance.size() < queries.size()) {
    progress.check();
    const std::size_t first = irradiance.size(), left = queries.size() - first;
    const std::size_t count = loop.divided() ? std::min(piece, left) : pace.next(left);
    std::vector<glm::vec3> found(count, glm::vec3(0.0f));
    loop.run(
        {first, count}, [&] { found = estimator.estimate(std::span(queries).subspan(first, count)); },
        [&](auto& state) {
          state.sameSize(found);
          state.requireFinite(numbersOf(found));
        });
    irradiance.insert(irradiance.end(), found.begin(), found.end());
    part.advance();
  }
  loop.end();
  part.finish();
  return irradiance;
}

/// Adds direct light. Returns the number of rays.
std::uint64_t addDirect(DirectLight& light, const CompiledScene& compiled,
                        std::span<const LightMapTexel> places, std::uint64_t seed,
                        std::vector<glm::vec3>& irradiance, const Progress& progress) {
  const std::vector<device::Receiver> receivers = gatherReceivers(compiled, places, 1, 1, seed);
  std::uint64_t done = 0, rays = 0;
  WorkPart part(progress, "direct", [&](auto& state) {
    state.value(done);
    state.value(rays);
    state.growing(irradiance, done);
    state.requireFinite(numbersOf(irradiance));
  });
  if (part.finished()) return rays;
  SharedLoop loop(part, "direct light");
  Pace pace(leastQueries, mostQueries);
  const std::size_t piece = SharedLoop::pieceSize(receivers.size(), leastQueries, mostQueries);
  while (done < receivers.size()) {
    progress.check();
    const std::size_t left = receivers.size() - done;
    const std::size_t count = loop.divided() ? std::min(piece, left) : pace.next(left);
    std::vector<PointIrradiance> found(count, PointIrradiance{glm::vec4(0.0f), glm::vec4(0.0f)});
    std::uint64_t own = 0;
    const auto compute = [&] {
      const std::uint64_t before = light.rays();
      found = light.at(std::span(receivers).subspan(done, count));
      own = light.rays() - before;
    };
    loop.run({done, count}, compute, [&](auto& state) {
      state.sameSize(found);
      state.value(own);
      state.requireFinite(numbersOf(found));
    });
    for (std::size_t i = 0; i < count; ++i)
      irradiance[done + i] += glm::vec3(found[i].far + found[i].emitters);
    done += count;
    rays += own;
    part.advance();
  }
  loop.end();
  part.finish();
  return rays;
}

/// Returns the regions of triangles, [triangle].
std::vector<std::uint32_t> regionsOf(const DensitySurface& surface) {
  std::vector<std::uint32_t> regions;
  regions.reserve(surface.places.size());
  for (const device::SurfacePlace& place : surface.places)
    regions.push_back(place.region & ~PRELIGHT_PLANAR_REGION);
  return regions;
}

/// Returns values of a layout's texels on its grid, [y][x]; 0 where there is none.
std::vector<glm::vec3> onGrid(const LightMapLayout& layout, std::span<const glm::vec3> values) {
  LightMap map;
  map.layout = layout;
  map.values.assign(3 * layout.texelCount(), 0.0f);
  setIrradiance(values, map);
  std::vector<glm::vec3> grid;
  grid.reserve(layout.texelCount());
  for (std::size_t i = 0; i < map.values.size(); i += 3)
    grid.emplace_back(map.values[i], map.values[i + 1], map.values[i + 2]);
  return grid;
}

}  // namespace

std::uint64_t usualPhotons(std::size_t texels) {
  constexpr std::uint64_t perTexel = 4, least = 50'000, most = 2'000'000;
  return std::clamp<std::uint64_t>(perTexel * texels, least, most);
}

double widestEstimate(const CompiledScene& scene) {
  return widestShare * 0.5 * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
}

namespace {

/// Number of photons for a place's guide.
constexpr int guideNearest = 50;

}  // namespace

GatherRequest gatherRequest(const IndirectRequest& request) {
  GatherRequest gather;
  gather.raysPerReceiver = raysPerReceiver(request);
  gather.seed = request.seed;
  gather.longWay = request.longWay;
  return gather;
}

namespace {

/// Returns whether photons represent the direct light of emissive triangles alone. Of many, the few rays per
/// emitter would be noisier.
bool emittersByPhotons(const TransportScene& scene, const IndirectRequest& request) {
  return !request.directByPhotons && scene.lights().emitters.size() > DirectLight::mostIntegratedEmitters;
}

}  // namespace

PhotonRequest indirectPhotons(const TransportScene& scene, const IndirectRequest& request) {
  return {.kind = request.directByPhotons ? PhotonKind::All : PhotonKind::Indirect,
          .emittersDirectly = emittersByPhotons(scene, request),
          .photons = request.photons.value_or(usualPhotons(0)),
          .seed = request.seed};
}

IndirectLight::IndirectLight(const LitScene& lit, TransportScene& scene, const SurfacePatches& patches,
                             const DensitySurface& surface, const IndirectRequest& request,
                             const Device& device, const SentPhotons& photons, const Progress& progress)
    : compiled_(lit.scene),
      patches_(patches),
      request_(request),
      width_(static_cast<std::uint32_t>(patches.layout().width)),
      spacing_(texelSpacing(compiled_, patches.layout())),
      earlierRays_(photons.report.rays),
      approximation_(scene.context(), patches.layout()),
      gather_(scene, approximation_, gatherRequest(request)) {
  const LightMapLayout& layout = patches.layout();
  const bool emitters = emittersByPhotons(scene, request);
  const bool direct = emitters || request.directByPhotons;
  const int nearest = direct ? std::max(request.nearestPhotons, leastNearestOfAll) : request.nearestPhotons;
  std::vector<glm::vec3> irradiance =
      irradianceOfPhotons(compiled_, patches, surface, photons.hits, nearest, device, progress);
  const std::vector<float> shares = sharesOfRegions(compiled_, regionsOf(surface), layout);
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] *= shares[i];
  const bool byRays = !emitters || !lit.lights.empty() || lit.sky != nullptr;
  if (!request.directByPhotons && byRays) {
    DirectLight shadowRays(compiled_, scene.tracer());
    shadowRays.setLights({lit.lights, lit.sky, lit.skyRotation, !emitters});
    earlierRays_ += addDirect(shadowRays, compiled_, layout.texels, request.seed, irradiance, progress);
  }
  approximation_.set(onGrid(layout, irradiance));
  if (request.gather == GatherChoice::Guided) {
    DensityOptions options;
    options.nearest = guideNearest;
    guide_.emplace(surface, options, device);
    guide_->setPhotons(patches.sort(photons.hits.photons));
  }
}

std::uint64_t IndirectLight::gatherSeed() const {
  return request_.seed + request_.gatherSeed * 0x9e3779b97f4a7c15u;
}

std::vector<device::Receiver> IndirectLight::receiversAt(std::span<const LightMapTexel> places) const {
  return gatherReceivers(compiled_, places, receiversPerPlace(request_), raysPerReceiver(request_),
                         gatherSeed());
}

std::vector<glm::vec3> IndirectLight::gather(std::span<const LightMapTexel> places, Progress& progress) {
  return request_.gather == GatherChoice::Cache ? gatherSome(places, progress) : gatherAll(places, progress);
}

std::vector<glm::vec3> IndirectLight::gatherSome(std::span<const LightMapTexel> places, Progress& progress) {
  CachedGatherRequest request;
  request.rays = request_.rays;
  request.seed = gatherSeed();
  request.width = width_;
  request.cache.error = request_.cacheError;
  request.cache.leastReach = leastReach * spacing_;
  request.cache.mostReach = std::max(request.cache.leastReach, widestEstimate(compiled_));
  return gatherCached(gather_, compiled_, places, request, progress, records_);
}

std::vector<glm::vec3> IndirectLight::gatherAll(std::span<const LightMapTexel> places, Progress& progress) {
  const std::vector<device::Receiver> receivers = receiversAt(places);
  const std::uint32_t count = receiversPerPlace(request_);
  const std::vector<glm::vec3> found =
      guide_ ? gatherGuided(places, receivers, progress) : gather_.gather(receivers, progress);
  records_ = places.size();
  if (count == 1) return found;
  std::vector<glm::vec3> irradiance(places.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < found.size(); ++i)
    irradiance[i / count] += found[i] / static_cast<float>(count);
  return irradiance;
}

std::vector<glm::vec3> IndirectLight::gatherSurface(Progress& progress) {
  const std::vector<LightMapTexel>& places = patches_.layout().texels;
  if (request_.gather != GatherChoice::All || !request_.spreadsExcess) return gather(places, progress);
  const std::vector<device::Receiver> receivers = receiversAt(places);
  const std::uint32_t count = receiversPerPlace(request_);
  BoundedGather bounded(gather_, receivers.size());
  gather_.gather(receivers, bounded, progress);
  records_ = places.size();
  std::vector<glm::vec3> irradiance(places.size(), glm::vec3(0.0f)), excess = irradiance;
  const float share = 1.0f / static_cast<float>(count);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    irradiance[i / count] += share * bounded.irradiance()[i].bounded;
    excess[i / count] += share * bounded.irradiance()[i].excess;
  }
  spreadExcess(patches_.layout(), excess, irradiance);
  return irradiance;
}

std::vector<glm::vec3> IndirectLight::gatherGuided(std::span<const LightMapTexel> places,
                                                   std::span<const device::Receiver> receivers,
                                                   Progress& progress) {
  const std::size_t count = receivers.size() / std::max<std::size_t>(1, places.size());
  std::vector<std::uint32_t> patches;
  for (const std::uint32_t patch : patches_.at(places)) patches.insert(patches.end(), count, patch);
  const std::vector<float> guides =
      guide_->guides(densityQueries(receivers, AroundNormal::Shading, widestEstimate(compiled_), patches));
  GuidedGather guided(gather_, guides, receivers.size());
  gather_.gather(receivers, guided, progress);
  return guided.irradiance();
}

std::vector<float> IndirectLight::gatherIncident(std::span<const LightMapTexel> places, Progress& progress,
                                                 int order) {
  const std::size_t length = 3 * static_cast<std::size_t>(incidentValueCount(order));
  const std::uint32_t count = receiversPerPlace(request_);
  const std::vector<float> found = gather_.gatherIncident(receiversAt(places), progress, order);
  std::vector<float> incident(length * places.size(), 0.0f);
  for (std::size_t i = 0; i < found.size(); ++i)
    incident[i / (length * count) * length + i % length] += found[i] / static_cast<float>(count);
  return incident;
}

namespace {

// Photons and rays in flight, and their kernels.
constexpr std::uint64_t blockBytes = std::uint64_t{80} << 20;
constexpr double bytesPerLanding = 160.0;  // per photon: as it landed, while maps are made, and on the device
constexpr double mostLandings = 3.0;       // per photon; whiter scenes are rare

/// Returns the share of light that surfaces reflect diffusely, averaged over their area. Textures count as
/// white.
double meanAlbedo(const CompiledScene& scene) {
  double reflected = 0.0, area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double size = glm::length(geometricNormal(scene, t));
    reflected += size * luminance(glm::dvec3(scene.materials[scene.triangleMaterials[t]].albedo));
    area += size;
  }
  return area > 0.0 ? reflected / area : 0.0;
}

}  // namespace

std::uint64_t indirectLightBytes(const CompiledScene& scene, std::uint64_t photons) {
  const double albedo = std::min(meanAlbedo(scene), 0.99);
  // Without the first, which is direct light.
  const double landings = std::min(mostLandings, albedo / (1.0 - albedo));
  return blockBytes + static_cast<std::uint64_t>(bytesPerLanding * landings * static_cast<double>(photons));
}

}  // namespace prelight
