#pragma once

#include "viewer/quad_scene.h"

namespace prelight::test {

/// Scene of the window's test: three tilted quads under a light and a sky, with an AO and SH bake.
QuadScene windowScene();

/// Options of the first view.
viewer::RenderOptions windowOptions();

constexpr const char* windowTitle = "prelight-window-probe";

}  // namespace prelight::test
