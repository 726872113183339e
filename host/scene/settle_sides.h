#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/scene.h"

namespace prelight {

/// Determines to which side the surfaces of a scene face, once for all users of the scene
/// (docs/conventions.md, "Sides"). Changes winding, normals and Primitive::bothSides where necessary, and
/// reports it in Scene::sides and in the warnings. The scene must be as its file has it, at rest. Returns the
/// compiled scene.
CompiledScene settleSides(Scene& scene, Warnings& warnings);

}  // namespace prelight
