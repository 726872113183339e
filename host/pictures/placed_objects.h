#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "pictures/drawing_session.h"

namespace prelight::pictures {

/// A glTF file that is put into a scene.
struct PlacedObject {
  std::filesystem::path file;
  glm::dvec3 at{0.0};       ///< m, where the file's origin goes, world space
  double yawDegrees = 0.0;  ///< counter-clockwise seen from above
  double scale = 1.0;

  glm::dmat4 transform() const;
};

/// An object as it was added to a scene.
struct AddedObject {
  int node = 0;       ///< its number in the scene
  OpenedScene alone;  ///< where it stands, without the scene
};

/// Loads objects and adds them to a scene, which is not compiled anew.
std::vector<AddedObject> addObjects(DrawingSession& session, const std::vector<PlacedObject>& objects,
                                    Scene& scene);

}  // namespace prelight::pictures
