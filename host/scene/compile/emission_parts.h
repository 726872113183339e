#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// The parts of a compiled scene's emissive triangles (EmissionParts); none where all emit evenly. Triangles
/// are cut where their textures are most uneven, until the parts are even or many.
EmissionParts findEmissionParts(const CompiledScene& compiled, const std::vector<Image>& images);

/// The parts of the same meshes in another pose. Where triangles have vanished or come back, those of a
/// primitive all emit their mean.
EmissionParts followEmission(EmissionParts parts, const CompiledScene& before, const CompiledScene& now);

}  // namespace prelight
