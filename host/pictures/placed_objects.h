#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "pictures/drawing_session.h"

namespace prelight::pictures {

/// A glTF file that is added to a scene.
struct PlacedObject {
  std::filesystem::path file;
  glm::dvec3 at{0.0};       ///< m, position of the file's origin in world space
  double yawDegrees = 0.0;  ///< counter-clockwise as seen from above
  double scale = 1.0;

  glm::dmat4 transform() const;
};

/// An object that was added to a scene.
struct AddedObject {
  int node = 0;       ///< index of its node in the scene
  OpenedScene alone;  ///< the object in its place, without the scene
};

/// Loads objects and adds them to a scene, without compiling the scene again.
std::vector<AddedObject> addObjects(DrawingSession& session, const std::vector<PlacedObject>& objects,
                                    Scene& scene);

}  // namespace prelight::pictures
