#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cast/caster.h"
#include "cast/light_groups.h"
#include "charts/light_map_bake.h"
#include "gpu/tracer.h"

namespace prelight {

/// Light that comes straight from the scene's punctual lights and emissive surfaces, by shadow rays
/// (cast/light_caster.h). Textured emitters count with their mean radiance.
class DirectLightPart final : public LightMapPart {
 public:
  /// `rays`: of the hemisphere at each texel, a power of two, 16 and more; with emitters alone they matter.
  /// `coefficients`: of the map (LightMap). The scene, which has a light, and the tracer outlive it.
  DirectLightPart(const CompiledScene& scene, Tracer& tracer, std::uint32_t rays, std::uint64_t seed,
                  int coefficients = 1);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return rays_; }

 private:
  device::Receiver receiverOf(const LightMapTexel& texel, std::uint32_t index) const;
  void castBlock(std::span<const LightMapTexel> texels, std::span<float> values,
                 std::span<std::uint8_t> hidden);

  const CompiledScene& scene_;
  GroupedLights lights_;
  Caster caster_;
  std::size_t coefficients_;
  std::uint32_t receiversPerTexel_;
  std::uint32_t seed_;
  std::uint64_t rays_ = 0;
  std::vector<device::Receiver> receivers_;
  CastValues cast_;
};

}  // namespace prelight
