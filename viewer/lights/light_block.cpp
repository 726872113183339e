#include "viewer/lights/light_block.h"

#include <algorithm>
#include <vector>

#include "viewer/core/uniform_blocks.h"

namespace prelight::viewer {
namespace {

/// Radius of the ball of a light at one place, or a flag: whether the light has two sides or is a sky's lamp.
float sizeOrFlag(const ShadedLight& light) {
  if (light.kind == LightKind::Directional || light.kind == LightKind::Emitter ||
      light.kind == LightKind::Area)
    return light.twoSided || light.ofSky ? 1.0f : 0.0f;
  return light.radius;
}

constexpr int mostMaps = 256;  ///< of a picture; as lights.glsl has it

/// Returns the code of what shadows a light: shadow maps (< 0, with a quarter more where the transfer holds
/// it, too), the shells of a near lamp (>= 2), the transfer (1) or nothing.
float shadowCode(const ShadedLight& light) {
  if (light.firstMap >= 0)
    return -static_cast<float>(1 + light.firstMap + mostMaps * (light.maps - 1)) -
           (light.throughTransfer ? 0.25f : 0.0f);
  if (light.shadow >= 0) return static_cast<float>(light.shadow + 2);
  return light.throughTransfer ? 1.0f : 0.0f;
}

LightBlock pack(const ShadedLight& light) {
  const bool tabled =
      light.kind == LightKind::Profiled || light.kind == LightKind::Area || light.kind == LightKind::Cookie;
  return {glm::vec4(light.position, static_cast<float>(light.kind)),
          glm::vec4(light.direction, light.kind == LightKind::Emitter ? light.area
                                     : light.kind == LightKind::Directional
                                         ? light.radius
                                         : light.leastDistance * light.leastDistance),
          glm::vec4(light.intensity, light.range),
          glm::vec4(tabled ? light.profileStart : light.coneScale,
                    tabled ? static_cast<float>(light.entry) : light.coneOffset, shadowCode(light),
                    sizeOrFlag(light))};
}

}  // namespace

void fillLightBlock(const gl::Buffer& block, std::span<const ShadedLight> lights) {
  std::vector<LightBlock> packed(maxLights);
  std::transform(lights.begin(), lights.end(), packed.begin(), pack);
  block.fill(GL_UNIFORM_BUFFER, std::span<const LightBlock>(packed), GL_STREAM_DRAW);
}

}  // namespace prelight::viewer
