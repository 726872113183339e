#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::viewer {

/// Texture coordinates of every vertex of a CompiledScene for each texture of its material, transformed.
struct TexCoords {
  std::vector<glm::vec4> baseColorAndMetallicRoughness;  ///< [vertex], xy and zw
  std::vector<glm::vec2> emissive;                       ///< [vertex]
};

/// A primitive that the scene does not hold (a CompiledScene made without one) gets CompiledScene::texCoords.
TexCoords texCoords(const Scene& scene, const CompiledScene& compiled);

/// Where a normal texture lies on the surface.
struct NormalPlaces {
  std::vector<glm::vec2> coords;    ///< [vertex], transformed
  std::vector<glm::vec4> tangents;  ///< [vertex], world space, w +-1; 0: the file has none
};

NormalPlaces normalPlaces(const Scene& scene, const CompiledScene& compiled);

/// The material `index` of a CompiledScene: the scene's, or glTF's default. Without a scene behind it, a
/// Lambertian one of the compiled albedo.
Material materialAt(const Scene& scene, const CompiledScene& compiled, std::size_t index);

}  // namespace prelight::viewer
