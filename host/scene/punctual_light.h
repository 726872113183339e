#pragma once

#include "prelight/compiled_scene.h"
#include "shared/shade_types.h"

namespace prelight {

/// A light as kernels/core/punctual_funcs.cl reads it, in scene coordinates.
device::PunctualLight deviceLight(const Light& light, const CompiledScene& scene);

}  // namespace prelight
