#pragma once

#include <span>

#include "viewer/gl/buffer.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

/// Replaces the contents of the uniform block `Lights` of shaders/lights.glsl: maxLights lights at most.
void fillLightBlock(const gl::Buffer& block, std::span<const ShadedLight> lights);

}  // namespace prelight::viewer
