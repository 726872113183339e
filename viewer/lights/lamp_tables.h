#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/scene.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

/// Tables of lights that shaders look up: profiles (transport/profile_funcs.cl),
/// cookies (shaders/cookies.glsl) and
/// shapes (shaders/area_lights.glsl).
class LampTables {
 public:
  /// Makes them those of lights, where they are not, and sets their entries.
  void set(std::span<const Light> lights, std::span<ShadedLight> shaded);

  const std::vector<glm::vec4>& texels() const { return texels_; }
  /// Another one whenever texels() have changed.
  std::size_t version() const { return version_; }

 private:
  void fill(std::vector<Light> parts, std::span<const ShadedLight> shaded);

  std::vector<Light> lights_;  ///< of which the texels are; what does not matter to them is left out
  std::vector<std::size_t> entries_;
  std::vector<glm::vec4> texels_;
  std::size_t version_ = 0;
};

}  // namespace prelight::viewer
