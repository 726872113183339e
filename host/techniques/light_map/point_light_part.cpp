#include "techniques/light_map/point_light_part.h"

#include <numbers>

#include "basis/incident_values.h"

namespace prelight {

PointLightPart::PointLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                               int coefficients)
    : scene_(scene),
      groups_(lights.groups),
      caster_(scene, punctualLightsOf(lights), tracer, incidentOrderOf(coefficients)),
      coefficients_(static_cast<std::size_t>(coefficients)) {}

void PointLightPart::add(std::span<const LightMapTexel> texels, int, std::span<float> values,
                         std::span<std::uint8_t>) {
  addMeans(texels, nullptr, 1, 1.0f, values);
}

void PointLightPart::refine(std::span<const LightMapTexel> texels, const TexelCells& cells, int,
                            std::span<float> values) {
  addMeans(texels, &cells, TexelCells::placeCount, 1.0f, values);
  addMeans(texels, nullptr, 1, -1.0f, values);
}

/// Adds `factor` times the mean over receivers, `perTexel` each.
void PointLightPart::addMeans(std::span<const LightMapTexel> texels, const TexelCells* cells,
                              std::uint32_t perTexel, float factor, std::span<float> values) {
  spreadReceivers(scene_, texels, cells, perTexel, receivers_);
  caster_.cast(receivers_, cast_);
  const std::size_t groups = groups_.size();
  for (std::size_t r = 0; r < receivers_.size(); ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t g = 0; g < groups; ++g)
        for (std::size_t i = 0; i < coefficients_; ++i)
          values[(3 * (r / perTexel) + c) * coefficients_ + i] +=
              factor * std::numbers::pi_v<float> * groups_[g].color[static_cast<int>(c)] *
              cast_[((3 * r + c) * groups + g) * coefficients_ + i] / static_cast<float>(perTexel);
}

}  // namespace prelight
