#pragma once

#include "scene/compiled_scene.h"
#include "scene/scene.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// The camera's part of the parameters.
void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& parameters);

}  // namespace prelight::reference
