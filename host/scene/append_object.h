#pragma once

#include <glm/glm.hpp>
#include <string>

#include "prelight/scene.h"

namespace prelight {

/// Appends everything that another scene draws behind the contents of a scene, so that existing vertices keep
/// their indices when it is compiled. `place` transforms the object's world space to the scene's. The object
/// becomes one node called `name`, whose number is returned. Its lights, cameras and animations are left out.
int appendObject(Scene& scene, const Scene& object, const std::string& name, const glm::dmat4& place);

}  // namespace prelight
