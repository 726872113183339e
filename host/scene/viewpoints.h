#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// A place that surfaces are seen or lit from.
struct Viewpoint {
  glm::dvec3 place{0.0};  ///< scene coordinates
  bool camera = false;    ///< otherwise a lamp
  std::string name = {};  ///< of a lamp, for people
};

/// A scene's cameras, then its lamps: point and spot lights, and for each emissive primitive a place just in
/// front of its largest triangle. At most `most`, evenly picked among the cameras and among the lamps.
std::vector<Viewpoint> viewpointsOf(const Scene& scene, const CompiledScene& compiled, std::size_t most);

}  // namespace prelight
