#pragma once

#include "export/export_request.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Gives the document's scene a sky, EXT_lights_image_based, in place of one that it has. Returns how many
/// pictures that took.
std::size_t addSky(GltfDocument& document, const Environment& sky);

/// Where what is exported holds the sky's diffuse light: takes it out of the scene's own image-based lights,
/// by what is asked of lights. What they had stays in extras.prelight.irradianceCoefficients.
void exportSkies(GltfDocument& document, BakedLights lights);

}  // namespace prelight
