#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/scene.h"

namespace prelight {

/// The result of turnWoundBack().
struct WoundBack {
  std::size_t triangles = 0;        ///< in meshes, however often these are drawn
  double share = 0.0;               ///< share of the area of all meshes as nodes draw them, at rest
  std::vector<std::string> meshes;  ///< names of the meshes concerned, or their numbers
};

/// Reverses triangles all of whose vertex normals look to the side on which their corners run clockwise, as
/// in mirrored meshes whose scale was applied: the normals define the front, and winding follows them.
WoundBack turnWoundBack(Scene& scene);

/// Determines to which side the surfaces of a scene face, once for all users of the scene
/// (docs/conventions.md, "Sides"). Changes winding, normals and Primitive::bothSides where necessary, and
/// reports it in Scene::sides and in the warnings. The scene must be as its file has it, at rest. Returns the
/// compiled scene.
CompiledScene settleSides(Scene& scene, Warnings& warnings);

}  // namespace prelight
