#pragma once

#include "prelight/compiled_scene.h"
#include "shared/shade_types.h"

namespace prelight {

/// Returns a light as kernels/core/punctual_funcs.cl reads it, in scene coordinates. The place of its profile
/// is not set.
device::PunctualLight deviceLight(const Light& light, const CompiledScene& scene);

}  // namespace prelight
