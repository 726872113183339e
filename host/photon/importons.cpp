#include "photon/importons.h"

#include <algorithm>
#include <numeric>

#include "base/luminance.h"
#include "photon/importance_sources.h"

namespace prelight {

namespace {

constexpr std::uint64_t pilotsShare = 8;  ///< number of photons per pilot
constexpr std::uint64_t leastImportons = 8192, mostImportons = 32768;
constexpr std::uint64_t importonSeed = 0x1f83d9abfb41bd6bu, pilotSeed = 0x5be0cd19137e2179u;

double powerOf(const device::Photon& photon) {
  return luminance({photon.power[0], photon.power[1], photon.power[2]});
}

glm::dvec3 placeOf(const device::Photon& photon) {
  return {photon.position[0], photon.position[1], photon.position[2]};
}

/// Calls `take` with each hit and the number of earlier hits of its path; hits of a path are in order.
template <typename Take>
void forRanks(const PhotonHits& hits, std::size_t paths, const Take& take) {
  std::vector<std::uint32_t> before(paths, 0);
  for (std::size_t i = 0; i < hits.photons.size(); ++i)
    take(hits.photons[i], hits.paths[i], before[hits.paths[i]]++);
}

std::size_t countOf(const PhotonSources& sources) {
  return std::accumulate(sources.sources.begin(), sources.sources.end(), std::size_t{0},
                         [](std::size_t sum, const device::PhotonSource& s) { return sum + s.count; });
}

glm::dvec3 middleOf(std::span<const LandedImporton> importons, const glm::dvec3& otherwise) {
  glm::dvec3 sum(0.0);
  double power = 0.0;
  for (const LandedImporton& importon : importons) {
    sum += importon.power * importon.position;
    power += importon.power;
  }
  return power > 0.0 ? sum / power : otherwise;
}

/// Returns the contribution of each pilot's path to a picture, by the importance of its first place.
std::vector<double> broughtBy(const PhotonHits& pilots, std::size_t paths, const ImportanceMap& importance) {
  std::vector<double> brought(paths, 0.0);
  forRanks(pilots, paths, [&](const device::Photon& photon, std::uint32_t path, std::uint32_t rank) {
    if (rank == 0) brought[path] = powerOf(photon) * importance.at(placeOf(photon));
  });
  return brought;
}

/// Returns the least power of photons by place. A photon of that power contributes a third of the mean;
/// roulette among photons that contribute nearly as much would only increase noise.
LeastPower leastPower(const ImportanceMap& importance, double broughtByAll, double power, double photons) {
  LeastPower least{importance.grid(), {}};
  const double most = boundOfPower * power / photons, enough = broughtByAll / (3.0 * photons);
  for (const double value : importance.values())
    least.watts.push_back(static_cast<float>(value > 0.0 ? std::min(enough / value, most) : most));
  return least;
}

}  // namespace

Importons sendImportons(const CompiledScene& compiled, TransportScene& scene, const CameraAxes& eye,
                        const PhotonRequest& request, Progress& progress) {
  PhotonRequest importons;
  importons.kind = PhotonKind::All;
  importons.photons = std::clamp(request.photons / pilotsShare, leastImportons, mostImportons);
  PhotonSources sources;
  sources.eye = eye;
  device::PhotonSource source{};
  source.kind = PRELIGHT_SOURCE_EYE;
  source.count = static_cast<std::uint32_t>(importons.photons);
  source.seed = seedOfSource(request.seed ^ importonSeed, 0);
  sources.sources.push_back(source);
  sources.powers.push_back(1.0);
  PhotonTracer tracer(compiled, scene);
  PhotonHits hits;
  Importons found;
  found.rays = tracer.trace(importons, sources, hits, progress).rays;
  // The first place is seen, the second is gathered from, and light at later places is on its way there.
  const std::uint32_t first = request.kind == PhotonKind::Indirect ? 2 : 1;
  forRanks(hits, source.count, [&](const device::Photon& photon, std::uint32_t, std::uint32_t rank) {
    if (rank >= first) found.landed.push_back({placeOf(photon), powerOf(photon)});
  });
  return found;
}

SentPhotons sendByImportance(const CompiledScene& compiled, TransportScene& scene, const CameraAxes& eye,
                             const PhotonRequest& request, Progress& progress) {
  const Importons importons = sendImportons(compiled, scene, eye, request, progress);
  const ImportanceMap importance(compiled, importons.landed);
  const glm::dvec3 middle = 0.5 * (glm::dvec3(compiled.boundsMin) + glm::dvec3(compiled.boundsMax));
  PhotonTracer tracer(compiled, scene);
  PhotonRequest pilotRequest;
  pilotRequest.kind = PhotonKind::All;
  pilotRequest.depth = 64;
  const PhotonSources pilots = pilotSources(compiled, scene.lights(), middleOf(importons.landed, middle),
                                            request.photons / pilotsShare, request.seed ^ pilotSeed);
  PhotonHits hits;
  const std::uint64_t pilotRays = tracer.trace(pilotRequest, pilots, hits, progress).rays;
  const std::vector<double> brought = broughtBy(hits, countOf(pilots), importance);
  PhotonSources sources = sourcesByImportance(pilots, brought, request.photons, request.seed);
  SentPhotons sent;
  if (sources.sources.empty()) {
    sent = sendPhotons(compiled, scene, request, progress);
  } else {
    sources.least = leastPower(importance, std::accumulate(brought.begin(), brought.end(), 0.0),
                               std::accumulate(sources.powers.begin(), sources.powers.end(), 0.0),
                               static_cast<double>(countOf(sources)));
    sent.report = tracer.trace(request, sources, sent.hits, progress);
  }
  sent.report.rays += importons.rays + pilotRays;
  return sent;
}

}  // namespace prelight
