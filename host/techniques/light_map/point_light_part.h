#pragma once

#include <cstdint>
#include <vector>

#include "cast/light_groups.h"
#include "cast/point_light_caster.h"
#include "charts/light_map_bake.h"
#include "gpu/tracer.h"

namespace prelight {

/// Light that comes straight from punctual lights: exact at a place, with sharp edges of shadows between
/// places.
class PointLightPart final : public LightMapPart {
 public:
  /// `lights`: of the scene, with a punctual one. `coefficients`: of the map (LightMap). The scene and the
  /// tracer outlive it.
  PointLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                 int coefficients = 1);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  bool isSharp() const override { return true; }
  void refine(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
              std::span<float> values) override;
  std::uint64_t rays() const override { return caster_.rays(); }

 private:
  void addMeans(std::span<const LightMapTexel> texels, const TexelCells* cells, std::uint32_t perTexel,
                float factor, std::span<float> values);

  const CompiledScene& scene_;
  std::vector<LightGroup> groups_;
  PointLightCaster caster_;
  std::size_t coefficients_;
  std::vector<device::Receiver> receivers_;
  std::vector<float> cast_;
};

}  // namespace prelight
