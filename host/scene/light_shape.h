#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// Of one side, m2.
double shapeArea(const LightShape& shape);

/// Corners of a polygon in world space.
std::vector<glm::dvec3> cornersOf(const Light& light);

/// A small part of an area light that stands for its surroundings.
struct LightPatch {
  glm::dvec3 position;  ///< world space
  glm::dvec3 normal;    ///< unit
};

/// Patches of the same area, spread evenly over an area light: the same for the same light.
std::vector<LightPatch> patchesOf(const Light& light, int count);

/// Takes the area lights among `lights` out and makes black surfaces of the scene of them that emit their
/// light: for what traces light, which knows no other. True where there were any; the scene has to be
/// compiled anew.
bool makeSurfacesOf(std::vector<Light>& lights, Scene& scene);

}  // namespace prelight
