#include "photon/importance_sources.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "photon/direction_cells.h"

namespace prelight {

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

}  // namespace prelight
