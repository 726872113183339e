#pragma once

#include "viewer/window/controls.h"

namespace prelight::viewer {

/// Draws the list of debug views that can be shown, in the panel that is being drawn.
void drawDebugList(Controls& controls);

}  // namespace prelight::viewer
