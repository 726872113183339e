#pragma once

#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// Sets the camera's part of the parameters.
void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& parameters);

/// Sets the parameters that all paths of a picture share, other than the camera.
void setPathParameters(const ReferenceRequest& request, const TransportScene& scene,
                       device::ReferenceParameters& parameters);

}  // namespace prelight::reference
