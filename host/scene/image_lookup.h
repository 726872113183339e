#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Values of an image as stored, 0..1, at coordinates of the image, between texels as `use` says; (0, 0) is
/// the upper left corner.
glm::vec4 sampleImage(const Image& image, const TextureRef& use, const glm::vec2& uv);

}  // namespace prelight
