#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/scene.h"

namespace prelight {

/// Settles which way the surfaces of a scene face, once for all that reads it (docs/conventions.md, "Sides"):
/// changes winding, normals and Primitive::bothSides where they have to be, and tells of it in Scene::sides
/// and in the warnings. The scene is as its file has it, at rest. Returns it compiled.
CompiledScene settleSides(Scene& scene, Warnings& warnings);

}  // namespace prelight
