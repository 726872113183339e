#pragma once

#include "scene/compiled_scene.h"
#include "shared/reference_types.h"

namespace prelight {

/// A light as kernels/core/punctual_funcs.cl reads it, in scene coordinates.
device::ReferenceLight deviceLight(const Light& light, const CompiledScene& scene);

}  // namespace prelight
