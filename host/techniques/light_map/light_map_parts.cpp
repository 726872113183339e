#include "techniques/light_map/light_map_parts.h"

#include <algorithm>
#include <numbers>

#include "basis/incident_values.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

/// Samples of emitters that a receiver of a texel has: 16 for up to 256 rays of the texel, and as many for
/// each further 256.
std::uint32_t samplesOf(std::uint32_t rays) {
  return std::max(1u, 16u * std::max(1u, rays / 256u) / SpreadCaster::receiversOf(rays));
}

constexpr std::uint32_t samplesPerPoint = 16;  // DirectLight's of a sky
constexpr std::size_t pointsPerBlock = std::size_t{1} << 16;

void addIrradiance(std::span<const glm::vec3> irradiance, std::span<float> values) {
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) values[3 * i + c] += irradiance[i][static_cast<int>(c)];
}

/// Both [texel][channel][value].
void addIncident(std::span<const float> incident, std::span<float> values) {
  for (std::size_t i = 0; i < incident.size(); ++i) values[i] += incident[i];
}

}  // namespace

EmitterLightPart::EmitterLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                                   std::uint32_t rays, std::uint64_t seed, int coefficients)
    : lights_(emittersOf(lights, samplesOf(rays))),
      column_(lights_, incidentOrderOf(coefficients)),
      caster_(scene, tracer, {}, {&column_}, rays, seed),
      coefficients_(static_cast<std::size_t>(coefficients)) {}

void EmitterLightPart::add(std::span<const LightMapTexel> texels, int, std::span<float> values,
                           std::span<std::uint8_t> hidden) {
  addPlaces(texels, nullptr, values, hidden);
}

void EmitterLightPart::addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int,
                                    std::span<float> values, std::span<std::uint8_t> hidden) {
  addPlaces(texels, &cells, values, hidden);
}

std::uint64_t EmitterLightPart::rays() const {
  return caster_.receivers() * (caster_.caster().raysPerReceiver() + lights_.rays.size());
}

void EmitterLightPart::addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells,
                                 std::span<float> values, std::span<std::uint8_t> hidden) {
  const std::size_t groups = lights_.groups.size();
  caster_.cast(texels, cells, 0, hidden,
               [&](std::size_t texel, std::size_t r, float share, const CastRows& seen) {
                 const auto light = seen.of(column_).of<float>();
                 for (std::size_t c = 0; c < 3; ++c)
                   for (std::size_t g = 0; g < groups; ++g)
                     for (std::size_t i = 0; i < coefficients_; ++i)
                       values[(3 * texel + c) * coefficients_ + i] +=
                           std::numbers::pi_v<float> * lights_.groups[g].color[static_cast<int>(c)] *
                           light[((3 * r + c) * groups + g) * coefficients_ + i] * share;
               });
}

PointLightPart::PointLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                               int coefficients)
    : scene_(scene),
      groups_(lights.groups),
      caster_(scene, punctualLightsOf(lights), tracer, incidentOrderOf(coefficients)),
      coefficients_(static_cast<std::size_t>(coefficients)) {}

void PointLightPart::add(std::span<const LightMapTexel> texels, int, std::span<float> values,
                         std::span<std::uint8_t>) {
  addMeans(texels, nullptr, 1, 1.0f, values);
}

void PointLightPart::refine(std::span<const LightMapTexel> texels, const TexelCells& cells, int,
                            std::span<float> values) {
  addMeans(texels, &cells, TexelCells::placeCount, 1.0f, values);
  addMeans(texels, nullptr, 1, -1.0f, values);
}

/// Adds `factor` times the mean over receivers, `perTexel` each.
void PointLightPart::addMeans(std::span<const LightMapTexel> texels, const TexelCells* cells,
                              std::uint32_t perTexel, float factor, std::span<float> values) {
  spreadReceivers(scene_, texels, cells, perTexel, receivers_);
  caster_.cast(receivers_, cast_);
  const std::size_t groups = groups_.size();
  for (std::size_t r = 0; r < receivers_.size(); ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t g = 0; g < groups; ++g)
        for (std::size_t i = 0; i < coefficients_; ++i)
          values[(3 * (r / perTexel) + c) * coefficients_ + i] +=
              factor * std::numbers::pi_v<float> * groups_[g].color[static_cast<int>(c)] *
              cast_[((3 * r + c) * groups + g) * coefficients_ + i] / static_cast<float>(perTexel);
}

SkyLightPart::SkyLightPart(const CompiledScene& scene, Tracer& tracer, const Environment& sky,
                           double rotation, std::uint32_t rays, std::uint64_t seed)
    : scene_(scene),
      light_(scene, tracer),
      repeats_(std::max(1u, rays / samplesPerPoint)),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x5c1bu))) {
  light_.setLights({{}, &sky, rotation, false});
}

void SkyLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                       std::span<std::uint8_t>) {
  addPlaces(texels, nullptr, coefficients, values);
}

void SkyLightPart::addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells,
                                int coefficients, std::span<float> values, std::span<std::uint8_t>) {
  addPlaces(texels, &cells, coefficients, values);
}

void SkyLightPart::addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells, int coefficients,
                             std::span<float> values) {
  const std::size_t perBlock = std::max<std::size_t>(1, pointsPerBlock / repeats_);
  const std::size_t length = 3 * static_cast<std::size_t>(coefficients);
  std::vector<device::Receiver> receivers;
  for (std::size_t first = 0; first < texels.size(); first += perBlock) {
    const std::size_t count = std::min(perBlock, texels.size() - first);
    const auto some = texels.subspan(first, count);
    spreadReceivers(scene_, some, cells, repeats_, receivers);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      receivers[r].seed = seed_ ^ sampling::hashInteger(some[r / repeats_].texel);
      receivers[r].firstSample = static_cast<std::uint32_t>(r % repeats_);
    }
    const auto block = values.subspan(first * length, count * length);
    coefficients == 1 ? addIrradiance(receivers, block) : addIncident(receivers, coefficients, block);
  }
}

void SkyLightPart::addIrradiance(std::span<const device::Receiver> receivers, std::span<float> values) {
  const std::vector<PointIrradiance> light = light_.at(receivers);
  for (std::size_t p = 0; p < light.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c)
      values[3 * (p / repeats_) + c] += light[p].far[static_cast<int>(c)] / static_cast<float>(repeats_);
}

void SkyLightPart::addIncident(std::span<const device::Receiver> receivers, int coefficients,
                               std::span<float> values) {
  const std::size_t length = 3 * static_cast<std::size_t>(coefficients);
  const std::vector<float> light = light_.incidentAt(receivers, incidentOrderOf(coefficients));
  for (std::size_t p = 0; p < receivers.size(); ++p)
    for (std::size_t i = 0; i < length; ++i)
      values[length * (p / repeats_) + i] += light[length * p + i] / static_cast<float>(repeats_);
}

InsidePart::InsidePart(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed)
    : places_(scene, tracer, seed) {}

void InsidePart::add(std::span<const LightMapTexel> texels, int, std::span<float>,
                     std::span<std::uint8_t> hidden) {
  places_.mark(texels, hidden);
  rays_ += texels.size() * HiddenPlaces::raysPerPlace;
}

void IndirectLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                            std::span<std::uint8_t>) {
  if (coefficients == 1)
    addIrradiance(light_.gather(texels, progress_), values);
  else
    addIncident(light_.gatherIncident(texels, progress_, incidentOrderOf(coefficients)), values);
}

void PhotonLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                          std::span<std::uint8_t>) {
  const std::vector<device::DensityQuery> queries =
      densityQueries(compiled_, texels, radius_, patches_.at(texels));
  if (coefficients == 1)
    addIrradiance(estimator_.estimate(queries), values);
  else
    addIncident(estimator_.estimateIncident(queries, incidentOrderOf(coefficients)), values);
}

}  // namespace prelight
