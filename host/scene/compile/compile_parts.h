#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/deform.h"

namespace prelight {

/// Returns the materials of the compiled scene, as CompiledScene::materials stores them.
std::vector<CompiledMaterial> compileMaterials(const Scene& scene);

/// Adds the meshes of a flattened scene that are drawn more than once, and their placements.
void findShapes(const Scene& scene, const DrawnMeshes& meshes, CompiledScene& compiled);

/// Converts between an sRGB byte and linear [0,1].
float linearFromSrgb(std::uint8_t value);
std::uint8_t srgbFromLinear(float value);

}  // namespace prelight
