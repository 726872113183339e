#include "scene/punctual_light.h"

#include <algorithm>
#include <cmath>

#include "scene/light_profile.h"

namespace prelight {

device::PunctualLight deviceLight(const Light& light, const CompiledScene& scene) {
  device::PunctualLight d{};
  const glm::vec3 position(light.position - scene.origin);
  for (int c = 0; c < 3; ++c) {
    d.position[c] = position[c];
    d.intensity[c] = light.intensity[c];
    d.direction[c] = static_cast<float>(light.direction[c]);
  }
  d.kind = light.type == LightType::Directional ? PRELIGHT_DIRECTIONAL_LIGHT
           : light.type == LightType::Spot      ? PRELIGHT_SPOT_LIGHT
                                                : PRELIGHT_POINT_LIGHT;
  d.inverseRange = light.range > 0.0f ? 1.0f / light.range : 0.0f;
  // KHR_lights_punctual, "Inner and outer cone angles".
  const double outer = std::cos(static_cast<double>(light.outerConeAngle));
  const double scale = 1.0 / std::max(0.001, std::cos(static_cast<double>(light.innerConeAngle)) - outer);
  d.coneScale = static_cast<float>(scale);
  d.coneOffset = static_cast<float>(-outer * scale);
  if (light.profile == nullptr) return d;
  d.kind = PRELIGHT_PROFILED_LIGHT;
  const glm::vec3 pole = profilePole(light);
  for (int c = 0; c < 3; ++c) d.direction[c] = pole[c];
  d.profileStart = profileTurn(light);
  return d;
}

}  // namespace prelight
