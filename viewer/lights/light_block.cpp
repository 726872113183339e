#include "viewer/lights/light_block.h"

#include <algorithm>
#include <vector>

#include "viewer/core/uniform_blocks.h"

namespace prelight::viewer {
namespace {

LightBlock pack(const ShadedLight& light) {
  const bool tabled =
      light.kind == LightKind::Profiled || light.kind == LightKind::Area || light.kind == LightKind::Cookie;
  return {glm::vec4(light.position, static_cast<float>(light.kind)),
          glm::vec4(light.direction, light.kind == LightKind::Emitter ? light.area
                                     : light.ofSky                    ? light.radius
                                                   : light.leastDistance * light.leastDistance),
          glm::vec4(light.intensity, light.range),
          glm::vec4(tabled ? light.profileStart : light.coneScale,
                    tabled ? static_cast<float>(light.entry) : light.coneOffset,
                    light.shadow >= 0       ? static_cast<float>(light.shadow + 2)
                    : light.throughTransfer ? 1.0f
                                            : 0.0f,
                    light.twoSided || light.ofSky ? 1.0f : 0.0f)};
}

}  // namespace

void fillLightBlock(const gl::Buffer& block, std::span<const ShadedLight> lights) {
  std::vector<LightBlock> packed(maxLights);
  std::transform(lights.begin(), lights.end(), packed.begin(), pack);
  block.fill(GL_UNIFORM_BUFFER, std::span<const LightBlock>(packed), GL_STREAM_DRAW);
}

}  // namespace prelight::viewer
