#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pictures/picture_request.h"
#include "pictures/session/drawing_session.h"
#include "prelight/picture.h"

namespace prelight::pictures {

/// The sky of a picture.
struct PictureSky {
  std::optional<Environment> map;
  bool studio = false;    ///< the map is the built-in studio
  std::string name = {};  ///< if it has one
  double rotation = 0.0;  ///< radians, the sky's own
};

/// Chooses the first of these skies that there is: the one that is asked for, the one that the file's light
/// was baked under, the file's own, the studio if nothing at all gives light (with a note), none.
/// `lightsAsked` says that the options name lights, `lightBaked` that the file holds light as it was when
/// baked, and `camera` is the one that is asked for.
PictureSky choosePictureSky(DrawingSession& session, const std::filesystem::path& asked, bool lightsAsked,
                            bool lightBaked, const LoadedScene& loaded, std::optional<int> camera);

/// Chooses the sky of a picture: the map that is asked for, else as choosePictureSky() does.
PictureSky skyOfPicture(DrawingSession& session, const PictureRequest& asked, bool lightBaked,
                        const LoadedScene& loaded);

/// Adds a camera to a scene without cameras that shows all of it large in a picture of this size. In the
/// studio, primitives that are inside out and have no bake are turned, with a warning.
void frameScene(DrawingSession& session, bool studio, std::optional<int> width, int height,
                LoadedScene& loaded);

}  // namespace prelight::pictures
