#pragma once

#include "prelight/compiled_scene.h"
#include "shared/shade_types.h"

namespace prelight {

/// A light as kernels/core/punctual_funcs.cl reads it, in scene coordinates. Where its profile lies is left
/// open.
device::PunctualLight deviceLight(const Light& light, const CompiledScene& scene);

}  // namespace prelight
