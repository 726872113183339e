#include "gi/indirect_light.h"

#include <algorithm>
#include <cmath>

#include "photon/density_estimator.h"
#include "radiosity/direct_light.h"
#include "receivers/sampling.h"
#include "receivers/texel_receiver.h"

namespace prelight {

namespace {

/// The widest radius of density estimates, as a share of half the scene's diagonal.
constexpr double widestShare = 0.25;

std::uint32_t raysPerReceiver(const IndirectRequest& request) {
  return std::min(request.rays, GatherRequest::mostRaysPerReceiver);
}

/// Irradiance that photons tell by themselves, W/m2, at places of the surface (Larsen 2004, ch. 10).
std::vector<glm::vec3> irradianceOfPhotons(const CompiledScene& compiled,
                                           std::span<const LightMapTexel> places,
                                           const DensitySurface& surface, const PhotonHits& hits,
                                           int nearestPhotons, const Device& device) {
  DensityOptions options;
  options.nearest = nearestPhotons;
  DensityEstimator estimator(surface, options, device);
  estimator.setPhotons(makePhotonMaps(hits.photons, surface));
  return estimator.estimate(densityQueries(compiled, places, widestEstimate(compiled)));
}

void addDirect(DirectLight& light, const CompiledScene& compiled, std::span<const LightMapTexel> places,
               std::uint64_t seed, std::vector<glm::vec3>& irradiance) {
  const std::vector<PointIrradiance> found = light.at(gatherReceivers(compiled, places, 1, 1, seed));
  for (std::size_t i = 0; i < places.size(); ++i)
    irradiance[i] += glm::vec3(found[i].far + found[i].emitters);
}

/// Values of a layout's texels on its grid, [y][x]; 0 where there is none.
std::vector<glm::vec3> onGrid(const LightMapLayout& layout, std::span<const glm::vec3> values) {
  std::vector<glm::vec3> grid(layout.texelCount(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < values.size(); ++i) grid[layout.texels[i].texel] = values[i];
  return grid;
}

}  // namespace

std::vector<device::Receiver> gatherReceivers(const CompiledScene& compiled,
                                              std::span<const LightMapTexel> places, std::uint32_t count,
                                              std::uint32_t rays, std::uint64_t seed) {
  std::vector<device::Receiver> receivers;
  receivers.reserve(places.size() * count);
  const std::uint32_t folded =
      sampling::hashInteger(static_cast<std::uint32_t>(seed ^ (seed >> 32)) ^ 0x2545f491u);
  for (const LightMapTexel& place : places) {
    device::Receiver receiver = receiverAt(compiled, place);
    receiver.seed = sampling::hashInteger(place.texel + folded);
    for (std::uint32_t i = 0; i < count; ++i) {
      receiver.firstSample = i * rays;
      receivers.push_back(receiver);
    }
  }
  return receivers;
}

double widestEstimate(const CompiledScene& scene) {
  return widestShare * 0.5 * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
}

std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius) {
  std::vector<device::DensityQuery> queries;
  queries.reserve(places.size());
  for (const device::Receiver& r : gatherReceivers(compiled, places, 1, 0, 0)) {
    device::DensityQuery query{};
    for (int k = 0; k < 3; ++k) {
      query.position[k] = r.position[k];
      query.normal[k] = r.geometricNormal[k];
    }
    query.triangle = r.triangle;
    query.radius = static_cast<float>(radius);
    queries.push_back(query);
  }
  return queries;
}

GatherRequest gatherRequest(const IndirectRequest& request) {
  GatherRequest gather;
  gather.raysPerReceiver = raysPerReceiver(request);
  gather.seed = request.seed;
  gather.longWay = request.longWay;
  return gather;
}

namespace {

bool directByPhotons(const TransportScene& scene, const IndirectRequest& request) {
  // Few rays to many emitters would be noisier near them than photons.
  return request.directByPhotons || scene.lights().emitters.size() > DirectLight::mostIntegratedEmitters;
}

}  // namespace

PhotonRequest indirectPhotons(const TransportScene& scene, const IndirectRequest& request) {
  return {.kind = directByPhotons(scene, request) ? PhotonKind::All : PhotonKind::Indirect,
          .photons = request.photons,
          .seed = request.seed};
}

IndirectLight::IndirectLight(const LitScene& lit, TransportScene& scene, const LightMapLayout& layout,
                             const DensitySurface& surface, const IndirectRequest& request,
                             const Device& device, const SentPhotons& photons)
    : compiled_(lit.scene),
      request_(request),
      earlierRays_(photons.report.rays),
      approximation_(scene.context(), layout),
      gather_(scene, approximation_, gatherRequest(request)) {
  const bool all = directByPhotons(scene, request);
  const int nearest = all ? std::max(request.nearestPhotons, leastNearestOfAll) : request.nearestPhotons;
  std::vector<glm::vec3> irradiance =
      irradianceOfPhotons(compiled_, layout.texels, surface, photons.hits, nearest, device);
  if (!all) {
    DirectLight direct(compiled_, scene.tracer());
    direct.setLights({lit.lights, lit.sky, lit.skyRotation});
    addDirect(direct, compiled_, layout.texels, request.seed, irradiance);
    earlierRays_ += direct.rays();
  }
  approximation_.set(onGrid(layout, irradiance));
}

std::vector<glm::vec3> IndirectLight::gather(std::span<const LightMapTexel> places, Progress& progress) {
  const std::uint32_t rays = raysPerReceiver(request_), count = std::max(1u, request_.rays / rays);
  const std::vector<glm::vec3> found =
      gather_.gather(gatherReceivers(compiled_, places, count, rays, request_.seed), progress);
  if (count == 1) return found;
  std::vector<glm::vec3> irradiance(places.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < found.size(); ++i)
    irradiance[i / count] += found[i] / static_cast<float>(count);
  return irradiance;
}

std::vector<float> IndirectLight::gatherIncident(std::span<const LightMapTexel> places, Progress& progress,
                                                 int order) {
  const std::size_t length = 3 * static_cast<std::size_t>(incidentValueCount(order));
  const std::uint32_t rays = raysPerReceiver(request_), count = std::max(1u, request_.rays / rays);
  const std::vector<float> found =
      gather_.gatherIncident(gatherReceivers(compiled_, places, count, rays, request_.seed), progress, order);
  std::vector<float> incident(length * places.size(), 0.0f);
  for (std::size_t i = 0; i < found.size(); ++i)
    incident[i / (length * count) * length + i % length] += found[i] / static_cast<float>(count);
  return incident;
}

}  // namespace prelight
