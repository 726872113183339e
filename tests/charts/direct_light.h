#pragma once

#include <optional>

#include "techniques/light_map/light_map_parts.h"

namespace prelight::test {

/// All direct light of a scene with lights, as one part of a light map.
class DirectLight final : public LightMapPart {
 public:
  DirectLight(const CompiledScene& scene, Tracer& tracer, std::uint32_t rays, std::uint64_t seed,
              int coefficients = 1) {
    const GroupedLights lights = groupLights(scene, {{"all", {"*"}}});
    if (lights.emitters.empty())
      inside_.emplace(scene, tracer, seed);
    else
      emitters_.emplace(scene, tracer, lights, rays, seed, coefficients);
    if (!lights.tables.punctual.empty()) points_.emplace(scene, tracer, lights, coefficients);
  }

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override {
    if (inside_) inside_->add(texels, coefficients, values, hidden);
    if (emitters_) emitters_->add(texels, coefficients, values, hidden);
    if (points_) points_->add(texels, coefficients, values, hidden);
  }
  void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
                    std::span<float> values, std::span<std::uint8_t> hidden) override {
    if (inside_) inside_->addOverCells(texels, cells, coefficients, values, hidden);
    if (emitters_) emitters_->addOverCells(texels, cells, coefficients, values, hidden);
    if (points_) points_->addOverCells(texels, cells, coefficients, values, hidden);
  }
  bool isSharp() const override { return points_.has_value(); }
  void refine(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
              std::span<float> values) override {
    if (points_) points_->refine(texels, cells, coefficients, values);
  }
  std::uint64_t rays() const override {
    return (inside_ ? inside_->rays() : 0) + (emitters_ ? emitters_->rays() : 0) +
           (points_ ? points_->rays() : 0);
  }

 private:
  std::optional<InsidePart> inside_;
  std::optional<EmitterLightPart> emitters_;
  std::optional<PointLightPart> points_;
};

}  // namespace prelight::test
