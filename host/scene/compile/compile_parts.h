#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/deform.h"
#include "shared/scene_types.h"

namespace prelight {

/// Replaces the geometry and lights of a compiled scene by those of the scene's current pose, as
/// compileScene() computes them. Materials and images stay, and vertices keep their order. `origin`: of the
/// coordinates; none: that of compileScene(). Throws as compileScene() does, after which the compiled scene
/// is unusable.
void flattenAnew(const Scene& scene, CompiledScene& compiled,
                 const std::optional<glm::dvec3>& origin = std::nullopt);

/// Returns the materials of the compiled scene, as CompiledScene::materials stores them.
std::vector<CompiledMaterial> compileMaterials(const Scene& scene);

/// Adds the meshes of a flattened scene that are drawn more than once, and their placements.
void findShapes(const Scene& scene, const DrawnMeshes& meshes, CompiledScene& compiled);

/// Converts between an sRGB byte and linear [0,1].
float linearFromSrgb(std::uint8_t value);
std::uint8_t srgbFromLinear(float value);

/// Returns the value of DeviceTexture::wrapS and wrapT for a texture's mode.
inline std::uint32_t deviceWrap(WrapMode mode) {
  switch (mode) {
    case WrapMode::ClampToEdge:
      return PRELIGHT_WRAP_CLAMP;
    case WrapMode::MirroredRepeat:
      return PRELIGHT_WRAP_MIRROR;
    case WrapMode::Repeat:
      break;
  }
  return PRELIGHT_WRAP_REPEAT;
}

}  // namespace prelight
