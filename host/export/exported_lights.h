#pragma once

#include <cstddef>

#include "export/export_request.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Removes or marks the lights of nodes (KHR_lights_punctual, EXT_lights_ies), so that programs do not add
/// their light to a light map that holds it. Animations of removed lights are removed as well. Returns the
/// number of lights.
std::size_t exportLights(GltfDocument& document, BakedLights lights);

/// Adds a sky (EXT_lights_image_based) to the document's scene or replaces its sky. Returns the number of
/// pictures.
std::size_t addSky(GltfDocument& document, const Environment& sky);

/// Removes the diffuse light of the scene's image-based lights, as the exported data holds it, according to
/// `lights`. The original coefficients stay in extras.prelight.irradianceCoefficients.
void exportSkies(GltfDocument& document, BakedLights lights);

}  // namespace prelight
