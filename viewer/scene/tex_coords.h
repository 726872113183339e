#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::viewer {

/// Both sets of texture coordinates of every vertex, xy and zw; empty when no material asks for any.
std::vector<glm::vec4> texCoords(const CompiledScene& compiled);

/// Coordinates of a texture at a vertex of such.
glm::vec2 texturePlace(const TextureRef& use, const glm::vec4& coords);

/// The material `index` of a CompiledScene: the scene's, or glTF's default. Without a scene behind it, a
/// Lambertian one of the compiled albedo.
Material materialAt(const Scene& scene, const CompiledScene& compiled, std::size_t index);

}  // namespace prelight::viewer
