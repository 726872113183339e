#pragma once

#include "gather/indirect_light.h"
#include "lightmap/light_map_bake.h"
#include "photon/density_estimator.h"

namespace prelight {

/// Indirect light of a light map: irradiance alone, the coefficients for bump maps stay as they are.
class IndirectLightPart final : public LightMapPart {
 public:
  /// The arguments outlive it.
  IndirectLightPart(IndirectLight& light, Progress& progress) : light_(light), progress_(progress) {}

  std::string name() const override { return "indirect"; }
  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return light_.rays(); }

 private:
  IndirectLight& light_;
  Progress& progress_;
};

}  // namespace prelight
