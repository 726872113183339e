#include "techniques/light_map/emitter_light_part.h"

#include <algorithm>
#include <numbers>

#include "basis/incident_values.h"

namespace prelight {

namespace {

/// Samples of emitters that a receiver of a texel has: 16 for up to 256 rays of the texel, and as many for
/// each further 256.
std::uint32_t samplesOf(std::uint32_t rays) {
  return std::max(1u, 16u * std::max(1u, rays / 256u) / SpreadCaster::receiversOf(rays));
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

}  // namespace prelight
