#pragma once

#include <cstdint>

#include "charts/hidden_places.h"
#include "charts/light_map_bake.h"
#include "gpu/tracer.h"

namespace prelight {

/// No light, but which texels lie inside objects, for maps without direct light, whose part tells it as well.
class InsidePart final : public LightMapPart {
 public:
  /// The scene and the tracer outlive it.
  InsidePart(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return rays_; }

 private:
  HiddenPlaces places_;
  std::uint64_t rays_ = 0;
};

}  // namespace prelight
