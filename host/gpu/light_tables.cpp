#include "gpu/light_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "base/colour.h"
#include "prelight/error.h"
#include "scene/light_profile.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

using std::numbers::pi;
constexpr double wholeRange = 4294967296.0;

/// Share of the selection probability that is uniform, the rest being proportional to power: a weak light may
/// be the nearest one.
constexpr double evenShare = 0.5;

constexpr float brightestEmission = 1e12f;  ///< as in ShadeMaterial

/// Throws Error for lights that kernels cannot trace.
void refuseUntraceable(const Light& light) {
  if (light.type == LightType::Area)
    throw Error(ExitCode::RuntimeFailure, "light '" + light.name + "'", "an area light cannot be traced",
                "give the scene an emissive surface in its place");
  if (light.cookie != nullptr)
    throw Error(ExitCode::RuntimeFailure, "light '" + light.name + "'", "a cookie cannot be traced",
                "remove it from the light");
}

double power(const Light& light, double sceneRadius) {
  const double strength = luminance(glm::dvec3(light.intensity)) +
                          1e-6 * (light.intensity.x + light.intensity.y + light.intensity.z);
  switch (light.type) {
    case LightType::Directional:
      return strength * pi * sceneRadius * sceneRadius;
    case LightType::Spot:
      return strength * 2.0 * pi * (1.0 - std::cos(light.outerConeAngle));
    case LightType::Area:
    case LightType::Point:
      break;
  }
  if (light.profile != nullptr) return strength * profilePower(*light.profile);
  return strength * 4.0 * pi;
}

std::uint32_t append(std::vector<std::uint32_t>& tables, const std::vector<std::uint32_t>& bounds) {
  const auto first = static_cast<std::uint32_t>(tables.size());
  tables.insert(tables.end(), bounds.begin(), bounds.end());
  return first;
}

double power(const CompiledScene& scene, const Emitter& emitter) {
  const bool doubleSided = scene.materials[scene.triangleMaterials[emitter.triangle]].doubleSided;
  return pi * emitter.area * luminance(glm::dvec3(emitter.radiance)) * (doubleSided ? 2.0 : 1.0);
}

/// Weight of a texel: the mean luminance of the interpolated sky over it, times its solid angle. The weights
/// 1/8, 3/4, 1/8 along each axis are exact for the bilinear look-up.
class SkyWeights {
 public:
  explicit SkyWeights(const Environment& sky) : sky_(sky), luminance_(sky.radiance.size()) {
    for (std::size_t i = 0; i < luminance_.size(); ++i)
      luminance_[i] = luminance(glm::dvec3(sky.radiance[i]));
  }

  double at(int column, int row) const {
    const double solidAngle = std::cos(pi * row / sky_.height) - std::cos(pi * (row + 1) / sky_.height);
    return solidAngle * (0.125 * blurred(column, std::max(row - 1, 0)) + 0.75 * blurred(column, row) +
                         0.125 * blurred(column, std::min(row + 1, sky_.height - 1)));
  }

 private:
  double blurred(int column, int row) const {
    const std::size_t width = static_cast<std::size_t>(sky_.width),
                      first = static_cast<std::size_t>(row) * width;
    const auto x = static_cast<std::size_t>(column);
    return 0.125 * luminance_[first + (x + width - 1) % width] + 0.75 * luminance_[first + x] +
           0.125 * luminance_[first + (x + 1) % width];
  }

  const Environment& sky_;
  std::vector<double> luminance_;
};

/// Adds the sky's tables. Returns its mean radiance times the solid angle of the sphere.
double addSky(const Environment& sky, LightTables& result) {
  result.skyWidth = static_cast<std::uint32_t>(sky.width);
  result.skyHeight = static_cast<std::uint32_t>(sky.height);
  const SkyWeights weights(sky);
  std::vector<double> rows;
  std::vector<std::uint32_t> columns;
  columns.reserve(sky.radiance.size());
  for (int y = 0; y < sky.height; ++y) {
    std::vector<double> row;
    for (int x = 0; x < sky.width; ++x) row.push_back(weights.at(x, y));
    rows.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    append(columns, makeIntervals(row));
  }
  result.rowTable = append(result.tables, makeIntervals(rows));
  result.columnTable = append(result.tables, columns);
  result.sky.reserve(sky.radiance.size());
  for (const glm::vec3& radiance : sky.radiance) result.sky.emplace_back(radiance, 0.0f);
  return 2.0 * pi / sky.width * std::accumulate(rows.begin(), rows.end(), 0.0);
}

/// Adds intervals of a profile's columns, then of the rows in each column, weighted by emitted power.
std::uint32_t addChances(const LightProfile& profile, std::vector<std::uint32_t>& tables) {
  std::vector<double> columns;
  std::vector<std::uint32_t> rows;
  for (std::size_t column = 0; column + 1 < profile.turns.size(); ++column) {
    std::vector<double> powers;
    for (std::size_t row = 0; row + 1 < profile.heights.size(); ++row)
      powers.push_back(cellPower(profile, column, row));
    columns.push_back(std::accumulate(powers.begin(), powers.end(), 0.0));
    append(rows, makeIntervals(powers));
  }
  const std::uint32_t first = append(tables, makeIntervals(columns));
  append(tables, rows);
  return first;
}

void evenOut(std::vector<double>& groups) {
  const double sum = std::accumulate(groups.begin(), groups.end(), 0.0);
  for (double& group : groups)
    group =
        (sum > 0.0 ? (1.0 - evenShare) * group / sum : 0.0) + evenShare / static_cast<double>(groups.size());
}

}  // namespace

std::vector<std::uint32_t> makeIntervals(std::span<const double> weights) {
  assert(!weights.empty() && weights.size() < (std::size_t{1} << 31));
  double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const bool even = !(sum > 0.0);
  if (even) sum = static_cast<double>(weights.size());
  // Every interval has length 1; the rest is distributed by weight.
  const double spare = wholeRange - static_cast<double>(weights.size());
  std::vector<std::uint32_t> bounds;
  bounds.reserve(weights.size());
  double before = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double share = std::min(std::floor(before / sum * spare), spare);
    bounds.push_back(static_cast<std::uint32_t>(share + static_cast<double>(i)));
    before += even ? 1.0 : weights[i];
  }
  return bounds;
}

double intervalProbability(std::span<const std::uint32_t> bounds, std::size_t entry) {
  const double end = entry + 1 < bounds.size() ? bounds[entry + 1] : wholeRange;
  return (end - bounds[entry]) / wholeRange;
}

device::EmitterRange addEmitters(const CompiledScene& scene, std::span<const Emitter> emitters,
                                 std::span<const double> powers, LightTables& tables) {
  const std::vector<std::uint32_t> bounds = makeIntervals(powers);
  const device::EmitterRange range{static_cast<std::uint32_t>(tables.emitters.size()),
                                   static_cast<std::uint32_t>(emitters.size()),
                                   append(tables.tables, bounds)};
  for (const Emitter& emitter : emitters) tables.emitters.push_back(emitter.triangle);
  tables.emitterPowers.insert(tables.emitterPowers.end(), powers.begin(), powers.end());
  tables.emitterPower = std::accumulate(tables.emitterPowers.begin(), tables.emitterPowers.end(), 0.0);
  const bool parts = !scene.emissionParts.roots.empty();
  tables.emitterDensities.resize(parts ? tables.emitters.size() : scene.triangleCount(), 0.0f);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double density = intervalProbability(bounds, i) / emitters[i].area;
    tables.emitterDensities[parts ? range.first + i : emitters[i].triangle] =
        static_cast<float>(std::clamp(density, 1e-30, 1e30));
  }
  for (std::size_t i = 0; parts && i < emitters.size(); ++i) {
    tables.emitterPartOf.push_back(emitters[i].part);
    tables.emitterParts.emplace_back(emitters[i].origin, emitters[i].scale, 0.0f);
    tables.emitterRadiances.emplace_back(glm::min(emitters[i].radiance, brightestEmission), 0.0f);
  }
  return range;
}

void referToEmitters(const CompiledScene& scene, LightTables& tables) {
  const EmissionParts& parts = scene.emissionParts;
  if (parts.roots.empty() || tables.emitters.empty()) return;
  std::vector<std::uint32_t> emitterOf(parts.parts.size(), PRELIGHT_NO_EMITTER);
  for (std::size_t e = 0; e < tables.emitterPartOf.size(); ++e)
    emitterOf[tables.emitterPartOf[e]] = static_cast<std::uint32_t>(e);
  const auto refer = [&](std::uint32_t at) {
    if (at == EmissionParts::dark || (at & EmissionParts::leaf) == 0) return at;
    const std::uint32_t emitter = emitterOf[at & ~EmissionParts::leaf];
    return emitter == PRELIGHT_NO_EMITTER ? emitter : emitter | PRELIGHT_EMITTER_LEAF;
  };
  for (const std::uint32_t root : parts.roots) tables.emitterRoots.push_back(refer(root));
  for (const auto& node : parts.nodes)
    tables.emitterNodes.push_back({refer(node[0]), refer(node[1]), refer(node[2]), refer(node[3])});
}

std::vector<EmitterRun> emitterRuns(const LightTables& tables) {
  std::vector<EmitterRun> runs;
  for (std::uint32_t e = 0; e < tables.emitters.size(); ++e) {
    if (runs.empty() || runs.back().triangle != tables.emitters[e])
      runs.push_back({tables.emitters[e], e, 0, 0.0});
    ++runs.back().count;
    runs.back().power += tables.emitterPowers[e];
  }
  return runs;
}

void addProfiles(std::span<const Light* const> lights, LightTables& tables) {
  PackedProfiles packed;
  std::map<std::size_t, std::uint32_t> chances;  // by index of the profile
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i]->profile == nullptr) continue;
    const std::size_t entry = packed.add(*lights[i]);
    tables.punctual[i].profile = static_cast<std::uint32_t>(entry);
    const auto known = chances.find(entry);
    tables.punctual[i].profileTable = known != chances.end()
                                          ? known->second
                                          : chances[entry] = addChances(*lights[i]->profile, tables.tables);
  }
  tables.profiles = packed.texels();
}

LightTables makeLightTables(const CompiledScene& scene, const std::vector<Light>& lights,
                            const Environment* sky, bool choosePunctual) {
  LightTables result;
  const double radius = 0.5 * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
  std::vector<double> groups;
  std::vector<const Light*> shining;
  for (const Light& light : lights) {
    if (!shines(light.intensity)) continue;
    refuseUntraceable(light);
    shining.push_back(&light);
    result.punctual.push_back(deviceLight(light, scene));
    result.punctualPowers.push_back(power(light, radius));
  }
  if (choosePunctual) groups = result.punctualPowers;
  result.emitterGroup = static_cast<std::uint32_t>(groups.size());
  const std::vector<Emitter> emitters = emittersOf(scene);
  const bool emits = !emitters.empty();
  const bool skyShines = sky != nullptr && std::any_of(sky->radiance.begin(), sky->radiance.end(),
                                                       [](const auto& r) { return shines(r); });
  result.groupCount = static_cast<std::uint32_t>(groups.size()) + (emits ? 1 : 0) + (skyShines ? 1 : 0);
  result.tables.resize(result.groupCount);  // filled last, as the sky's power follows from its tables
  if (emits) {
    std::vector<double> powers;
    for (const Emitter& emitter : emitters) powers.push_back(power(scene, emitter));
    result.emitterTable = addEmitters(scene, emitters, powers, result).table;
    referToEmitters(scene, result);
    groups.push_back(result.emitterPower);
  }
  if (skyShines) result.skyPower = addSky(*sky, result) * pi * radius * radius;
  if (skyShines) groups.push_back(result.skyPower);
  addProfiles(shining, result);
  if (groups.empty()) return result;
  evenOut(groups);
  const std::vector<std::uint32_t> bounds = makeIntervals(groups);
  std::copy(bounds.begin(), bounds.end(), result.tables.begin());
  return result;
}

float skyTurn(double rotation) { return static_cast<float>(rotation / (2.0 * pi)); }

device::LightLayout lightLayout(const LightTables& l, double skyRotation) {
  device::LightLayout layout{};
  layout.groupCount = l.groupCount;
  layout.emitterGroup = l.emitterGroup;
  layout.emitterCount = static_cast<std::uint32_t>(l.emitters.size());
  layout.emitterTable = l.emitterTable;
  layout.rowTable = l.rowTable;
  layout.columnTable = l.columnTable;
  layout.skyWidth = l.skyWidth;
  layout.skyHeight = l.skyHeight;
  layout.skyTurn = skyTurn(skyRotation);
  return layout;
}

}  // namespace prelight
