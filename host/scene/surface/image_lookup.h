#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Returns the stored values of an image, 0..1, at coordinates of the image, interpolated as `use` says; (0,
/// 0) is the upper left corner.
glm::vec4 sampleImage(const Image& image, const TextureRef& use, const glm::vec2& uv);

}  // namespace prelight
