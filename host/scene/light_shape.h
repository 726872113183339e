#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns the area of one side of a shape, m2.
double shapeArea(const LightShape& shape);

/// Returns the corners of a polygonal light in world space.
std::vector<glm::dvec3> cornersOf(const Light& light);

/// A small part of an area light that represents its surroundings.
struct LightPatch {
  glm::dvec3 position;  ///< world space
  glm::dvec3 normal;    ///< unit
};

/// Returns `count` patches of equal area, evenly distributed over an area light; the same for the same light.
std::vector<LightPatch> patchesOf(const Light& light, int count);

/// Returns true when a light, or a part of an area light, lies within a scene's bounds.
bool liesWithin(const Light& light, const CompiledScene& scene);

/// Removes the area lights among `lights` and adds black surfaces that emit their light to the scene, for
/// methods that only support emissive surfaces. Returns true if there were any; the scene must then be
/// compiled anew.
bool makeSurfacesOf(std::vector<Light>& lights, Scene& scene);

}  // namespace prelight
