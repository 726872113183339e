#include "gather/light_map_parts.h"

namespace prelight {

void IndirectLightPart::add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                            std::span<std::uint8_t>) {
  const std::vector<glm::vec3> irradiance = light_.gather(texels, progress_);
  const auto stride = static_cast<std::size_t>(coefficients);
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) values[(3 * i + c) * stride] += irradiance[i][static_cast<int>(c)];
}

}  // namespace prelight
