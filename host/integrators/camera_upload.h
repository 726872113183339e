#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// The camera's part of the parameters.
void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& parameters);

}  // namespace prelight::reference
