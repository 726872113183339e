#pragma once

#include "export/export_request.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Adds a sky (EXT_lights_image_based) to the document's scene or replaces its sky. Returns the number of
/// pictures.
std::size_t addSky(GltfDocument& document, const Environment& sky);

/// Removes the diffuse light of the scene's image-based lights, as the exported data holds it, according to
/// `lights`. The original coefficients stay in extras.prelight.irradianceCoefficients.
void exportSkies(GltfDocument& document, BakedLights lights);

}  // namespace prelight
