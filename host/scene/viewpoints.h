#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// A place from which surfaces are seen or lit.
struct Viewpoint {
  glm::dvec3 place{0.0};  ///< scene coordinates
  bool camera = false;    ///< otherwise a lamp
  std::string name = {};  ///< name of a lamp, for messages
};

/// Returns a scene's cameras, then its lamps: point and spot lights, and for each emissive primitive a place
/// just in front of its largest triangle. Returns at most `most`, evenly selected from the cameras and from
/// the lamps.
std::vector<Viewpoint> viewpointsOf(const Scene& scene, const CompiledScene& compiled, std::size_t most);

}  // namespace prelight
