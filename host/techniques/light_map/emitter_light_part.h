#pragma once

#include <cstdint>

#include "cast/light_column.h"
#include "charts/light_map_bake.h"
#include "charts/spread_caster.h"
#include "gpu/tracer.h"

namespace prelight {

/// Light that comes straight from emissive surfaces, by samples of these and of the hemisphere
/// (cast/light_caster.h), and which texels lie inside objects. Textured emitters count with their mean
/// radiance.
class EmitterLightPart final : public LightMapPart {
 public:
  /// `lights`: of the scene, with an emitter. `rays`: of the hemisphere at each texel, a power of two, 16 and
  /// more. `coefficients`: of the map (LightMap). The scene and the tracer outlive it.
  EmitterLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                   std::uint32_t rays, std::uint64_t seed, int coefficients = 1);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
                    std::span<float> values, std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override;

 private:
  void addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells, std::span<float> values,
                 std::span<std::uint8_t> hidden);

  GroupedLights lights_;
  LightColumn column_;
  SpreadCaster caster_;
  std::size_t coefficients_;
};

}  // namespace prelight
