#pragma once

#include <span>

#include "pictures/drawing_session.h"
#include "prelight/picture.h"

namespace prelight::pictures {

/// What lights a picture.
struct PictureLight {
  std::span<const Light> lights;
  const Environment* sky = nullptr;  ///< nullptr: none
  bool shutIn = false;  ///< its lamps are the scene's own, and what stands around them casts shadows
};

/// Warns of a picture that is black all over, with the reasons: what gives no light, or that the camera sees
/// nothing; and else of lamps that are shut in.
void warnOfDarkness(DrawingSession& session, const Picture& picture, const OpenedScene& loaded,
                    const Camera& camera, const PictureLight& light);

}  // namespace prelight::pictures
