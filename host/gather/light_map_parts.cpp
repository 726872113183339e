#include "gather/light_map_parts.h"

namespace prelight {

namespace {

/// Adds irradiance to the first coefficient of texels.
void addIrradiance(std::span<const glm::vec3> irradiance, int coefficients, std::span<float> values) {
  const auto stride = static_cast<std::size_t>(coefficients);
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) values[(3 * i + c) * stride] += irradiance[i][static_cast<int>(c)];
}

}  // namespace

void IndirectLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                            std::span<std::uint8_t>) {
  addIrradiance(light_.gather(texels, progress_), coefficients, values);
}

void PhotonLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                          std::span<std::uint8_t>) {
  addIrradiance(estimator_.estimate(densityQueries(compiled_, texels, radius_)), coefficients, values);
}

}  // namespace prelight
