#pragma once

#include <vector>

#include "scene/gltf/load_parts.h"

namespace prelight {

/// Counts what the nodes draw before any of it is read. Throws InputError when that is out of proportion to
/// the file (more than 2^22 vertices or triangles plus 256 per byte of its data, where a node counts as 64
/// bytes): shared meshes, instances and accessors without data let a few bytes stand for any amount of
/// memory. Throws Error (OutOfMemory) when the arrays alone take more memory than the machine has.
void checkSceneSize(const LoadContext& context, const std::vector<SceneNode>& nodes);

}  // namespace prelight
