#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns the parts of a compiled scene's emissive triangles (EmissionParts), or none where all emission is
/// uniform. Triangles are cut where their textures vary most, until the parts are uniform or numerous.
EmissionParts findEmissionParts(const CompiledScene& compiled, const std::vector<Image>& images);

/// Returns the parts of the same meshes in another pose. If triangles of a primitive have vanished or come
/// back, all its triangles emit their mean.
EmissionParts followEmission(EmissionParts parts, const CompiledScene& before, const CompiledScene& now);

}  // namespace prelight
