#pragma once

#include <span>

#include "prelight/compiled_scene.h"
#include "viewer/core/uniform_blocks.h"
#include "viewer/core/view_state.h"
#include "viewer/lights/drawn_sky.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

/// Clip space of a tile from scene coordinates.
glm::mat4 tileFromScene(const View& view, const Tile& tile, const CompiledScene& compiled);

/// The uniforms that all draws of a tile share. `turns`: pixels of a square's side that take turns
/// with samples of lights.
FrameBlock frameBlockOf(const View& view, const Tile& tile, const CompiledScene& compiled, const SeenSky& sky,
                        std::span<const ShadedLight> lights, int turns);

}  // namespace prelight::viewer
