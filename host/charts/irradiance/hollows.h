#pragma once

#include <cstdint>
#include <span>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Moves the places of texels out of hollows smaller than a texel, as between parts of a chair that reach
/// into one another, if most of their squares lies open: a texel shows the light of its place wherever it is
/// seen. A place lies in a hollow where all of a few rays, or nearly all, meet something within a texel's
/// side. It moves to the open place that is nearest to the square's middle. Call it before findWalls(), and
/// not for maps that others filter without walls: there a texel below a wall has to stay dark. `ignored`:
/// [triangle] 1 where a triangle makes no hollow, because it will move. The tracer must be that of the scene.
void leaveHollows(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
                  std::span<const std::uint8_t> ignored = {});

}  // namespace prelight
