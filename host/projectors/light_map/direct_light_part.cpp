#include "projectors/light_map/direct_light_part.h"

#include <algorithm>
#include <numbers>

#include "basis/incident_values.h"
#include "receivers/sampling.h"
#include "receivers/texel_receiver.h"

namespace prelight {

namespace {

constexpr std::uint32_t leastLightRays = 16, mostLightRays = 256;

CastOptions castOptions(const GroupedLights& lights, std::uint32_t rays, int coefficients) {
  CastOptions options;
  // Where nothing emits but points, the hemisphere tells only whether a place is inside an object.
  options.raysPerReceiver =
      lights.emitters.empty() ? leastLightRays : std::clamp(rays, leastLightRays, mostLightRays);
  options.lights = &lights;
  options.incidentOrder = incidentOrderOf(coefficients);
  options.marksInside = true;
  return options;
}

}  // namespace

DirectLightPart::DirectLightPart(const CompiledScene& scene, Tracer& tracer, std::uint32_t rays,
                                 std::uint64_t seed, int coefficients)
    : scene_(scene),
      lights_(groupLights(scene, {{"all", {"*"}}})),
      caster_(scene, tracer, castOptions(lights_, rays, coefficients)),
      coefficients_(static_cast<std::size_t>(coefficients)),
      receiversPerTexel_(lights_.emitters.empty() ? 1u : std::max(1u, rays / mostLightRays)),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x11647u))) {
}

device::Receiver DirectLightPart::receiverOf(const LightMapTexel& texel, std::uint32_t index) const {
  device::Receiver receiver = receiverAt(scene_, texel);
  receiver.seed = seed_ ^ sampling::hashInteger(texel.texel);
  receiver.firstSample = index * caster_.raysPerReceiver();
  return receiver;
}

void DirectLightPart::add(std::span<const LightMapTexel> texels, int, std::span<float> values,
                          std::span<std::uint8_t> hidden) {
  const std::size_t perBlock = std::max<std::size_t>(1, caster_.blockSize() / receiversPerTexel_);
  const std::size_t length = 3 * coefficients_;
  for (std::size_t first = 0; first < texels.size(); first += perBlock) {
    const std::size_t count = std::min(perBlock, texels.size() - first);
    castBlock(texels.subspan(first, count), values.subspan(first * length, count * length),
              hidden.subspan(first, count));
  }
}

void DirectLightPart::castBlock(std::span<const LightMapTexel> texels, std::span<float> values,
                                std::span<std::uint8_t> hidden) {
  receivers_.clear();
  for (const LightMapTexel& texel : texels)
    for (std::uint32_t k = 0; k < receiversPerTexel_; ++k) receivers_.push_back(receiverOf(texel, k));
  caster_.cast(receivers_, cast_, {});
  rays_ += receivers_.size() * (caster_.raysPerReceiver() + lights_.rays.size());
  const std::uint32_t groups = caster_.groupCount();
  for (std::size_t r = 0; r < receivers_.size(); ++r) {
    const std::size_t texel = r / receiversPerTexel_;
    if (cast_.inside[r] != 0) hidden[texel] = 1;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::uint32_t g = 0; g < groups; ++g)
        for (std::size_t i = 0; i < coefficients_; ++i)
          values[(3 * texel + c) * coefficients_ + i] +=
              std::numbers::pi_v<float> * lights_.groups[g].color[static_cast<int>(c)] *
              cast_.lights[((3 * r + c) * groups + g) * coefficients_ + i] /
              static_cast<float>(receiversPerTexel_);
  }
}

}  // namespace prelight
