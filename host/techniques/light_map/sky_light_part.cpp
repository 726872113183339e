#include "techniques/light_map/sky_light_part.h"

#include <algorithm>

#include "basis/incident_values.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr std::uint32_t samplesPerPoint = 16;  // DirectLight's of a sky
constexpr std::size_t pointsPerBlock = std::size_t{1} << 16;

}  // namespace

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

}  // namespace prelight
