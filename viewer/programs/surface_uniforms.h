#pragma once

#include <array>

#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/shader_variant.h"
#include "viewer/programs/texture_units.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// Names of a texture in shaders.
struct SlotNames {
  TextureSlot slot;
  Feature feature;
  Unit unit;
  const char *u, *v;
};

/// [TextureSlot]
const std::array<SlotNames, surfaceTextures>& slotNames();

/// Sets what shaders/material.glsl reads of a surface in the program in use, whose features are given;
/// `white` stands for textures that it has not.
void setSurface(const Surface& surface, Features features, const gl::Texture& white,
                const gl::Program& program);

/// How texture coordinates become row 0 (u) or 1 (v) of a texture's (shaders/material.glsl).
glm::vec4 textureRow(const TextureRef& use, int row);

/// Backs of one-sided surfaces are not drawn.
void cullBacksOf(const Surface& surface);

/// Sets the values of attributes without an array: a white colour, an open sky.
void setAttributeDefaults();

/// Sets the accessibility of all vertices to one that shaders find from the light that arrives.
void setUnknownAccessibility();

}  // namespace prelight::viewer
