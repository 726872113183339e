#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"
#include "scene/lobes.h"

namespace prelight {

/// Returns the triangles whose materials make caustics (makesCaustics()).
std::vector<std::uint32_t> causticCasters(const CompiledScene& scene);

/// Returns the triangles of mirrors and smooth glass (scattersSharply()).
std::vector<std::uint32_t> sharpCasters(const CompiledScene& scene);

}  // namespace prelight
