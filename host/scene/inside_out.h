#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Primitives (numbers into CompiledScene::primitives) of closed bodies whose faces all look inwards though
/// nothing is inside, wherever their mesh is drawn: whoever made them meant the outside. Neither two-sided
/// nor emissive ones, nor any that other primitives or bodies lie in. None of scenes with lights or cameras,
/// which may be rooms, or of more than 1000 candidates.
std::vector<std::uint32_t> insideOutPrimitives(const Scene& scene, const CompiledScene& compiled);

/// Turns the faces and normals of primitives, of all nodes that draw them, and compiles the scene anew.
void turnFaces(const std::vector<std::uint32_t>& primitives, Scene& scene, CompiledScene& compiled);

}  // namespace prelight
