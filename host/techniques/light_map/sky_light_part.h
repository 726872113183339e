#pragma once

#include <cstdint>
#include <vector>

#include "charts/light_map_bake.h"
#include "gpu/tracer.h"
#include "prelight/picture.h"
#include "radiosity/direct_light.h"

namespace prelight {

/// Light that comes straight from the sky.
class SkyLightPart final : public LightMapPart {
 public:
  /// `rays`: at each texel, rounded to whole samplings of 16. What is given outlives it. `rotation`: of the
  /// sky, radians, counter-clockwise seen from above.
  SkyLightPart(const CompiledScene& scene, Tracer& tracer, const Environment& sky, double rotation,
               std::uint32_t rays, std::uint64_t seed);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
                    std::span<float> values, std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return light_.rays(); }

 private:
  void addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells, int coefficients,
                 std::span<float> values);
  void addIrradiance(std::span<const device::Receiver> receivers, std::span<float> values);
  void addIncident(std::span<const device::Receiver> receivers, int coefficients, std::span<float> values);

  const CompiledScene& scene_;
  DirectLight light_;
  std::uint32_t repeats_;
  std::uint32_t seed_;
};

}  // namespace prelight
