#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Whether a material sends light on in about one direction: glass, a mirror, or a lobe, unless it is
/// wide (PRELIGHT_NARROW_ALPHA in kernels/transport/lobe_funcs.cl). A texture of roughness may make it so.
/// Solid glass does whatever its roughness, as narrowLobes() has it there.
bool makesCaustics(const CompiledMaterial& material);

/// Triangles whose materials do.
std::vector<std::uint32_t> causticCasters(const CompiledScene& scene);

}  // namespace prelight
