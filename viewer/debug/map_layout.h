#pragma once

#include "prelight/light_map.h"
#include "viewer/core/render_inputs.h"

namespace prelight::viewer {

/// Returns the layout of the map that full shading gathers indirect light in, else that of the bake's light
/// map; nullptr: there is neither.
const LightMapLayout* mapLayoutOf(const RenderInputs& inputs);

}  // namespace prelight::viewer
