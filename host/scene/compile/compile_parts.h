#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/deform.h"

namespace prelight {

/// Materials of the flat scene, as CompiledScene::materials has them.
std::vector<CompiledMaterial> compileMaterials(const Scene& scene);

/// Adds the meshes of a flattened scene that are drawn more than once, and where.
void findShapes(const Scene& scene, const DrawnMeshes& meshes, CompiledScene& compiled);

/// sRGB byte to linear [0,1] and back.
float linearFromSrgb(std::uint8_t value);
std::uint8_t srgbFromLinear(float value);

}  // namespace prelight
