#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pictures/drawing_session.h"
#include "prelight/picture.h"

namespace prelight::pictures {

/// The sky of a picture.
struct PictureSky {
  std::optional<Environment> map;
  bool studio = false;    ///< it is the built-in studio
  std::string name = {};  ///< where it has one
  double rotation = 0.0;  ///< radians, that it has by itself
};

/// The sky that is asked for, the one that the file's light was baked under, the file's own, the studio where
/// nothing at all gives light (which is said), or none. `lightsAsked`: the options say what lights there are.
/// `lightBaked`: the file carries light as it was when baked. `camera`: the one that is asked for.
PictureSky choosePictureSky(DrawingSession& session, const std::filesystem::path& asked, bool lightsAsked,
                            bool lightBaked, const OpenedScene& loaded, std::optional<int> camera);

/// Prepares a scene without cameras for the studio: what is inside out and carries no bake is turned, which
/// is said, and a camera added that shows the scene large in a picture of this size.
void setUpStudio(DrawingSession& session, OpenedScene& loaded, std::optional<int> width, int height);

}  // namespace prelight::pictures
