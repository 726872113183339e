#pragma once

#include <glm/glm.hpp>
#include <string>

#include "prelight/scene.h"

namespace prelight {

/// Adds what another scene draws to a scene, behind all that it has, so that its vertices keep their numbers
/// when it is compiled. `place` takes the object's world space to the scene's. All of it is one node of that
/// name, whose number is returned. The object's lights, cameras and animations are left out.
int appendObject(Scene& scene, const Scene& object, const std::string& name, const glm::dmat4& place);

}  // namespace prelight
