#include "photon/importons.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/colour.h"
#include "photon/direction_cells.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr std::uint32_t gridSide = 32;
constexpr std::size_t areaPoints = 1 << 16;  ///< points that sample the surface area in each cube
/// Number of importons at which a cube's own density weighs as much as that around it.
constexpr double trusted = 8.0;

/// Returns points that are evenly distributed over the surface, each representing the same area.
std::vector<LandedImporton> pointsOfArea(const CompiledScene& scene) {
  std::vector<double> sums;
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    sums.push_back(area += 0.5 * glm::length(geometricNormal(scene, t)));
  std::vector<LandedImporton> points;
  for (std::size_t i = 0; i < areaPoints && area > 0.0; ++i) {
    const double wanted = (static_cast<double>(i) + 0.5) / areaPoints * area;
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, wanted);
    const glm::uvec3& v = scene.triangles[static_cast<std::size_t>(found - sums.begin())];
    const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(static_cast<std::uint32_t>(i), 0));
    points.push_back({(1.0 - b.x - b.y) * glm::dvec3(scene.positions[v.x]) +
                          b.x * glm::dvec3(scene.positions[v.y]) + b.y * glm::dvec3(scene.positions[v.z]),
                      area / areaPoints});
  }
  return points;
}

/// Returns sums over cubes of twice the size.
std::vector<double> joined(std::span<const double> cubes, std::size_t n) {
  const std::size_t half = n / 2;
  std::vector<double> sums(half * half * half, 0.0);
  for (std::size_t z = 0; z < n; ++z)
    for (std::size_t y = 0; y < n; ++y)
      for (std::size_t x = 0; x < n; ++x)
        sums[((z / 2) * half + y / 2) * half + x / 2] += cubes[(z * n + y) * n + x];
  return sums;
}

/// Returns the densities of n^3 cubes. Each cube counts `prior` of additional power, on the area that this
/// takes at the density of the larger cube around it.
std::vector<double> densities(std::span<const double> power, std::span<const double> area, std::size_t n,
                              double prior) {
  if (n == 1) return {area[0] > 0.0 ? power[0] / area[0] : 0.0};
  const std::vector<double> around = densities(joined(power, n), joined(area, n), n / 2, prior);
  std::vector<double> found(n * n * n);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t x = i % n, y = i / n % n, z = i / (n * n), half = n / 2;
    const double outer = around[((z / 2) * half + y / 2) * half + x / 2];
    found[i] = outer > 0.0 ? (power[i] + prior) / (area[i] + prior / outer) : 0.0;
  }
  return found;
}

}  // namespace

ImportanceMap::ImportanceMap(const CompiledScene& scene, std::span<const LandedImporton> importons) {
  const glm::dvec3 lower(scene.boundsMin), extent = glm::dvec3(scene.boundsMax) - lower;
  for (int k = 0; k < 3; ++k) grid_.lower[k] = scene.boundsMin[k];
  grid_.side = gridSide;
  const double longest = std::max({extent.x, extent.y, extent.z, 1e-30});
  grid_.cellsPerMetre = static_cast<float>(gridSide / longest);
  double power = 0.0;
  for (const LandedImporton& importon : importons) power += importon.power;
  const double prior = trusted * power / std::max<double>(1.0, static_cast<double>(importons.size()));
  values_ = densities(gathered(importons), gathered(pointsOfArea(scene)), gridSide, prior);
}

std::size_t ImportanceMap::cellOf(const glm::dvec3& position) const {
  std::size_t cell = 0;
  for (int k = 2; k >= 0; --k) {
    const double at = (position[k] - double{grid_.lower[k]}) * double{grid_.cellsPerMetre};
    cell = cell * gridSide + static_cast<std::size_t>(std::clamp(at, 0.0, gridSide - 1.0));
  }
  return cell;
}

std::vector<double> ImportanceMap::gathered(std::span<const LandedImporton> points) const {
  std::vector<double> sums(std::size_t{gridSide} * gridSide * gridSide, 0.0);
  for (const LandedImporton& point : points) sums[cellOf(point.position)] += point.power;
  return sums;
}

namespace {

using device::PhotonSource;
using device::SourceCell;

constexpr std::uint32_t pilotCells = 16;       ///< per side
constexpr double pilotsACell = 4.0;            ///< least number per cell
constexpr std::size_t mostEmittersApart = 16;  ///< triangles; more of them form one source without cells
constexpr double mostOfASource = 1 << 30;      ///< most photons per source

struct Shining {
  PhotonSource source{};
  double power = 0.0;
  glm::dvec3 axis{0.0};  ///< axis of its directions
  bool cells = true;
};

std::vector<Shining> lightsOf(const CompiledScene& scene, const LightTables& lights) {
  std::vector<Shining> found;
  const auto add = [&](std::uint32_t kind, std::uint32_t light, double power, const glm::dvec3& axis,
                       bool cells, std::uint32_t emitters = 0) {
    if (!(power > 0.0)) return;
    Shining l{{}, power, axis, cells};
    l.source.kind = kind;
    l.source.light = light;
    l.source.emitters = emitters;
    found.push_back(l);
  };
  for (std::uint32_t i = 0; i < lights.punctual.size(); ++i) {
    const float* d = lights.punctual[i].direction;
    add(PRELIGHT_SOURCE_PUNCTUAL, i, lights.punctualPowers[i], {d[0], d[1], d[2]}, true);
  }
  const std::vector<EmitterRun> runs = emitterRuns(lights);
  if (runs.size() > mostEmittersApart)
    add(PRELIGHT_SOURCE_EMITTERS, PRELIGHT_ALL_EMITTERS, lights.emitterPower, {0, 1, 0}, false);
  else
    for (const EmitterRun& run : runs)
      add(PRELIGHT_SOURCE_EMITTERS, run.first, run.power,
          glm::normalize(geometricNormal(scene, run.triangle)), true, run.count);
  if (!lights.sky.empty()) add(PRELIGHT_SOURCE_SKY, 0, lights.skyPower, {0, 1, 0}, true);
  return found;
}

/// Appends `copies` entries of a source's cell.
void addCells(std::uint32_t cell, std::uint32_t copies, std::vector<SourceCell>& cells) {
  for (std::uint32_t copy = 0; copy < copies; ++copy) cells.push_back({cell, copies, copy});
}

/// Contributions of one source's cells, or of the whole source if it has none.
struct Brought {
  std::vector<double> strengths;  ///< [cell], mean power times the RMS contribution of its photons
  std::uint32_t pilots = 0;       ///< per cell
};

Brought broughtBy(const PhotonSource& source, std::span<const double> brought) {
  const std::size_t cells = std::max(1u, source.cellCount);
  Brought result{std::vector<double>(cells, 0.0), static_cast<std::uint32_t>(brought.size() / cells)};
  for (std::size_t i = 0; i < brought.size(); ++i) result.strengths[i % cells] += brought[i] * brought[i];
  for (double& strength : result.strengths) strength = std::sqrt(strength * result.pilots);
  return result;
}

/// Gives a source's cells copies by their shares, and sets the source's number of photons; `photons`
/// corresponds to a share of 1.
void shareOut(std::span<const double> shares, double photons, PhotonSource& source,
              std::vector<SourceCell>& cells) {
  double sum = 0.0;
  source.firstCell = static_cast<std::uint32_t>(cells.size());
  for (std::uint32_t cell = 0; cell < shares.size(); ++cell) {
    const double copies = std::round(shares[cell]);
    sum += source.cellCount > 0 ? copies : shares[cell];
    if (source.cellCount > 0) addCells(cell, static_cast<std::uint32_t>(copies), cells);
  }
  const auto entries = static_cast<std::uint32_t>(cells.size()) - source.firstCell;
  if (source.cellCount > 0) source.cellCount = entries;
  const double of = std::max(1.0, static_cast<double>(entries));
  source.count =
      static_cast<std::uint32_t>(of * std::max(1.0, std::round(std::min(photons * sum, mostOfASource) / of)));
}

}  // namespace

PhotonSources pilotSources(const CompiledScene& scene, const LightTables& lights, const glm::dvec3& middle,
                           std::uint64_t photons, std::uint64_t seed) {
  PhotonSources result;
  const glm::dvec3 lower(scene.boundsMin), upper(scene.boundsMax);
  result.centre = middle;
  result.radius = 0.5 * glm::length(upper - lower) + glm::length(middle - 0.5 * (lower + upper));
  const std::vector<Shining> found = lightsOf(scene, lights);
  const double all = std::accumulate(found.begin(), found.end(), 0.0,
                                     [](double sum, const Shining& l) { return sum + l.power; });
  for (const Shining& light : found) {
    PhotonSource source = light.source;
    const double share = static_cast<double>(photons) * light.power / all;
    std::uint32_t side = light.cells ? pilotCells : 1;
    while (side > 1 && share < pilotsACell * side * side) side /= 2;
    source.cellsASide = side;
    source.cellCount = light.cells ? side * side : 0;
    source.firstCell = static_cast<std::uint32_t>(result.cells.size());
    for (std::uint32_t cell = 0; cell < source.cellCount; ++cell) addCells(cell, 1, result.cells);
    const std::uint32_t cells = std::max(1u, source.cellCount);
    source.count = cells * static_cast<std::uint32_t>(std::ceil(std::min(share, mostOfASource) / cells));
    const glm::dvec3 tangent = frameAlong(light.axis).tangent;
    for (int k = 0; k < 3; ++k) source.tangent[k] = static_cast<float>(tangent[k]);
    source.seed = seedOfSource(seed, result.sources.size());
    result.powers.push_back(light.power);
    result.sources.push_back(source);
  }
  return result;
}

PhotonSources sourcesByImportance(const PhotonSources& pilots, std::span<const double> brought,
                                  std::uint64_t photons, std::uint64_t seed) {
  std::vector<Brought> found;
  double strength = 0.0, power = 0.0;
  std::size_t first = 0;
  for (std::size_t s = 0; s < pilots.sources.size(); ++s) {
    found.push_back(broughtBy(pilots.sources[s], brought.subspan(first, pilots.sources[s].count)));
    first += pilots.sources[s].count;
    strength = std::accumulate(found[s].strengths.begin(), found[s].strengths.end(), strength);
    power += pilots.powers[s];
  }
  PhotonSources result;
  result.centre = pilots.centre;
  result.radius = pilots.radius;
  for (std::size_t s = 0; s < pilots.sources.size() && strength > 0.0; ++s) {
    const double cellPower = pilots.powers[s] / power / static_cast<double>(found[s].strengths.size());
    std::vector<double> shares;
    for (const double ofCell : found[s].strengths)
      shares.push_back(1.0 + (boundOfPower - 1.0) * ofCell / strength / cellPower);
    PhotonSource source = pilots.sources[s];
    source.seed = seedOfSource(seed, s);
    shareOut(shares, static_cast<double>(photons) / boundOfPower * cellPower, source, result.cells);
    result.powers.push_back(pilots.powers[s]);
    result.sources.push_back(source);
  }
  return result;
}

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
  const bool storesDirect = request.kind != PhotonKind::Indirect || request.emittersDirectly;
  const std::uint32_t first = storesDirect ? 1 : 2;
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
