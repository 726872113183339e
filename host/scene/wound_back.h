#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// What turnWoundBack() found.
struct WoundBack {
  std::size_t triangles = 0;        ///< of meshes, however often these are drawn
  double share = 0.0;               ///< of the area of all meshes as nodes draw them, at rest
  std::vector<std::string> meshes;  ///< names of those that have some, or their numbers
};

/// Turns triangles whose three vertex normals all look to the side where their corners run clockwise, as
/// those of mirrored meshes whose scale was applied: normals tell the front, and winding follows them.
WoundBack turnWoundBack(Scene& scene);

}  // namespace prelight
