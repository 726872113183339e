#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Values of an image as stored, 0..1, bilinear between texels; (0, 0) is the upper left corner.
glm::vec4 sampleImage(const Image& image, const glm::vec2& uv, WrapMode wrapS, WrapMode wrapT);

}  // namespace prelight
