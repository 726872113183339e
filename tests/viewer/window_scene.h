#pragma once

#include "viewer/quad_scene.h"

namespace prelight::test {

/// What the window's test shows: three tilted quads under a light and a sky, with an AO and SH bake.
QuadScene windowScene();

/// The first view of it.
viewer::RenderOptions windowOptions();

constexpr const char* windowTitle = "prelight-window-probe";

}  // namespace prelight::test
