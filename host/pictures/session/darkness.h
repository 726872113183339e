#pragma once

#include <span>

#include "pictures/session/drawing_session.h"
#include "prelight/picture.h"

namespace prelight::pictures {

/// The lights and the sky of a picture.
struct PictureLight {
  std::span<const Light> lights;
  const Environment* sky = nullptr;  ///< nullptr: none
  bool shutIn = false;  ///< the lamps are the scene's own, and the objects around them cast shadows
};

/// Warns of a picture that is black everywhere and gives the reasons: nothing gives light, or the camera sees
/// nothing. Otherwise warns of lamps that are shut in.
void warnOfDarkness(DrawingSession& session, const Picture& picture, const LoadedScene& loaded,
                    const Camera& camera, const PictureLight& light);

}  // namespace prelight::pictures
