#include "photon/photon_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/colour.h"
#include "photon/direction_cells.h"

namespace prelight {

namespace {

std::vector<std::uint32_t> trianglesOf(const CompiledScene& scene, bool (*casts)(const CompiledMaterial&)) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (casts(scene.materials[scene.triangleMaterials[t]])) casters.push_back(t);
  return casters;
}

}  // namespace

std::vector<std::uint32_t> causticCasters(const CompiledScene& scene) {
  return trianglesOf(scene, makesCaustics);
}

std::vector<std::uint32_t> sharpCasters(const CompiledScene& scene) {
  return trianglesOf(scene, scattersSharply);
}

namespace {

using device::PhotonSource;

using std::numbers::pi;
constexpr std::uint64_t mostPhotons = 0xf0000000u;  ///< per source
constexpr std::size_t mostAimedEmitters = 256;      ///< triangles; beyond this number, emitters are not aimed
constexpr std::uint32_t finestCells = 64;           ///< per side

/// A source with the total power that its photons carry.
struct Candidate {
  PhotonSource source{};
  double power = 0.0;  ///< power of the source
  double sent = 0.0;   ///< power in the directions of its cells
  std::vector<std::uint32_t> cells;
};

Candidate everywhere(std::uint32_t kind, std::uint32_t light, double power) {
  Candidate c;
  c.source.kind = kind;
  c.source.light = light;
  c.power = c.sent = power;
  return c;
}

void setSphere(const glm::dvec3& lower, const glm::dvec3& upper, PhotonSources& result) {
  result.centre = 0.5 * (lower + upper);
  result.radius = 0.5 * glm::length(upper - lower);
}

/// Distributes photons by the power of each candidate; all cells of a candidate receive the same number.
void shareOut(std::vector<Candidate> candidates, std::uint64_t photons, std::uint64_t seed,
              PhotonSources& result) {
  double sum = 0.0;
  for (const Candidate& c : candidates) sum += c.sent;
  if (!(sum > 0.0)) return;
  for (Candidate& c : candidates) {
    if (!(c.sent > 0.0)) continue;
    const double wanted = static_cast<double>(photons) * c.sent / sum;
    std::uint64_t count =
        std::clamp<std::uint64_t>(static_cast<std::uint64_t>(std::llround(wanted)), 1, mostPhotons);
    c.source.cellCount = static_cast<std::uint32_t>(c.cells.size());
    if (!c.cells.empty()) count = (count + c.cells.size() - 1) / c.cells.size() * c.cells.size();
    c.source.count = static_cast<std::uint32_t>(count);
    c.source.firstCell = static_cast<std::uint32_t>(result.cells.size());
    c.source.seed = seedOfSource(seed, result.sources.size());
    for (const std::uint32_t cell : c.cells) result.cells.push_back({cell, 1, 0});
    result.powers.push_back(c.power);
    result.sources.push_back(c.source);
  }
}

/// Chooses the cells of a candidate's directions that may reach a caster from anywhere in `from`.
void aim(Candidate& c, const Ball& from, std::span<const DirectionFrame> frames, DirectionMap map,
         std::span<const Ball> casters, std::uint64_t photons) {
  std::uint32_t side = finestCells;
  c.cells = cellsTowards(from, frames, map, casters, side);
  // Cells are coarser if photons are few, as every cell takes at least one.
  while (side > 4 && c.cells.size() * 4 > photons) {
    side /= 2;
    c.cells = cellsTowards(from, frames, map, casters, side);
  }
  c.sent = c.power * static_cast<double>(c.cells.size()) / (double(side) * side);
  if (c.cells.size() == std::size_t{side} * side) {
    c.cells.clear();
    return;
  }
  c.source.cellsASide = side;
  for (int k = 0; k < 3; ++k) c.source.tangent[k] = static_cast<float>(frames[0].tangent[k]);
}

Candidate aimedEmitters(const CompiledScene& scene, const EmitterRun& run, std::span<const Ball> casters,
                        std::uint64_t photons) {
  const std::uint32_t t = run.triangle;
  Candidate c = everywhere(PRELIGHT_SOURCE_EMITTERS, run.first, run.power);
  c.source.emitters = run.count;
  std::vector<DirectionFrame> frames{frameAlong(glm::normalize(geometricNormal(scene, t)))};
  if (scene.materials[scene.triangleMaterials[t]].doubleSided)
    frames.push_back({-frames[0].axis, frames[0].tangent});
  aim(c, ballAround(scene, std::span(&t, 1)), frames, {DirectionMap::Hemisphere, 0.0}, casters, photons);
  return c;
}

Candidate aimedPunctual(const LightTables& lights, std::uint32_t index, std::span<const Ball> casters,
                        std::uint64_t photons) {
  const device::PunctualLight& light = lights.punctual[index];
  Candidate c = everywhere(PRELIGHT_SOURCE_PUNCTUAL, index, lights.punctualPowers[index]);
  const glm::dvec3 position(light.position[0], light.position[1], light.position[2]);
  const glm::dvec3 axis(light.direction[0], light.direction[1], light.direction[2]);
  const double least = light.kind == PRELIGHT_SPOT_LIGHT
                           ? std::clamp(-double(light.coneOffset) / double(light.coneScale), -1.0, 1.0)
                           : -1.0;
  const DirectionFrame frame = frameAlong(axis);
  aim(c, {position, 0.0}, std::span(&frame, 1), {DirectionMap::Cap, least}, casters, photons);
  return c;
}

}  // namespace

std::uint32_t seedOfSource(std::uint64_t seed, std::size_t source) {
  const std::uint64_t mixed = (seed + 1) * 0x9e3779b97f4a7c15ull + source * 0xd1b54a32d192ed03ull;
  return static_cast<std::uint32_t>(mixed >> 32) ^ static_cast<std::uint32_t>(mixed);
}

PhotonSources allSources(const CompiledScene& scene, const LightTables& lights, std::uint64_t photons,
                         std::uint64_t seed) {
  PhotonSources result;
  setSphere(scene.boundsMin, scene.boundsMax, result);
  std::vector<Candidate> candidates;
  for (std::uint32_t i = 0; i < lights.punctual.size(); ++i)
    candidates.push_back(everywhere(PRELIGHT_SOURCE_PUNCTUAL, i, lights.punctualPowers[i]));
  if (!lights.emitters.empty())
    candidates.push_back(everywhere(PRELIGHT_SOURCE_EMITTERS, PRELIGHT_ALL_EMITTERS, lights.emitterPower));
  if (!lights.sky.empty()) candidates.push_back(everywhere(PRELIGHT_SOURCE_SKY, 0, lights.skyPower));
  shareOut(std::move(candidates), photons, seed, result);
  return result;
}

PhotonSources sourcesTowardsCasters(const CompiledScene& scene, const LightTables& lights,
                                    std::uint64_t photons, std::uint64_t seed) {
  return sourcesTowards(scene, lights, causticCasters(scene), photons, seed);
}

PhotonSources sourcesTowards(const CompiledScene& scene, const LightTables& lights,
                             const std::vector<std::uint32_t>& triangles, std::uint64_t photons,
                             std::uint64_t seed) {
  PhotonSources result;
  if (triangles.empty()) return result;
  const Ball all = ballAround(scene, triangles);
  result.centre = all.centre;
  result.radius = all.radius;
  const double sceneRadius = 0.5 * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
  const double disc = std::pow(all.radius / sceneRadius, 2.0);  // share of distant light that enters it
  const std::vector<Ball> casters = clusterBalls(scene, triangles);
  const std::vector<EmitterRun> runs = emitterRuns(lights);
  const std::uint64_t each = photons / std::max<std::size_t>(1, lights.punctual.size() + runs.size());
  std::vector<Candidate> candidates;
  for (std::uint32_t i = 0; i < lights.punctual.size(); ++i) {
    const bool afar = lights.punctual[i].kind == PRELIGHT_DIRECTIONAL_LIGHT;
    candidates.push_back(afar ? everywhere(PRELIGHT_SOURCE_PUNCTUAL, i, disc * lights.punctualPowers[i])
                              : aimedPunctual(lights, i, casters, each));
  }
  if (runs.size() > mostAimedEmitters) {
    candidates.push_back(everywhere(PRELIGHT_SOURCE_EMITTERS, PRELIGHT_ALL_EMITTERS, lights.emitterPower));
  } else {
    for (const EmitterRun& run : runs) candidates.push_back(aimedEmitters(scene, run, casters, each));
  }
  if (!lights.sky.empty()) candidates.push_back(everywhere(PRELIGHT_SOURCE_SKY, 0, disc * lights.skyPower));
  shareOut(std::move(candidates), photons, seed, result);
  return result;
}

}  // namespace prelight
