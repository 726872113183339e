#pragma once

#include <vector>

#include "pictures/session/drawing_session.h"
#include "prelight/draw.h"

namespace prelight::pictures {

/// An object that was added to a scene.
struct AddedObject {
  int node = 0;       ///< index of its node in the scene
  LoadedScene alone;  ///< the object in its place, without the scene
};

/// Loads objects and adds them to a scene, without compiling the scene again.
std::vector<AddedObject> addObjects(DrawingSession& session, const std::vector<PlacedObject>& objects,
                                    Scene& scene);

}  // namespace prelight::pictures
