#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns the primitives (indices into CompiledScene::primitives) of closed bodies whose faces all look
/// inwards although nothing is inside, wherever their mesh is drawn: their outside was meant. Excludes
/// two-sided and emissive primitives and those that contain other primitives or bodies. Returns none for
/// scenes with lights or cameras, which may be rooms, or with more than 1000 candidates.
std::vector<std::uint32_t> insideOutPrimitives(const Scene& scene, const CompiledScene& compiled);

/// Reverses the faces and normals of primitives, for all nodes that draw them, and compiles the scene anew.
void turnFaces(const std::vector<std::uint32_t>& primitives, Scene& scene, CompiledScene& compiled);

/// Tells which primitives of a file are inside out, of which there is at least one.
std::string insideOutText(const std::filesystem::path& file, const CompiledScene& scene,
                          const std::vector<std::uint32_t>& primitives);

}  // namespace prelight
