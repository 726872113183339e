#pragma once

#include <cstddef>

#include "export/export_request.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Removes or marks the lights of nodes (KHR_lights_punctual, EXT_lights_ies), so that programs do not add
/// their light to a light map that holds it. Animations of removed lights are removed as well. Returns the
/// number of lights.
std::size_t exportLights(GltfDocument& document, BakedLights lights);

}  // namespace prelight
