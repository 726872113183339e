#pragma once

#include <span>

#include "prelight/compiled_scene.h"
#include "viewer/drawn_sky.h"
#include "viewer/lighting.h"
#include "viewer/uniform_blocks.h"
#include "viewer/view_state.h"

namespace prelight::viewer {

/// What a tile of a view has in common for all its draws. `turns`: pixels of a square's side that take turns
/// with samples of lights.
FrameBlock frameBlockOf(const View& view, const Tile& tile, const CompiledScene& compiled, const SeenSky& sky,
                        std::span<const ShadedLight> lights, int turns);

}  // namespace prelight::viewer
