#pragma once

#include <optional>

#include "prelight/error.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// The sky that EXT_lights_image_based gives the document's scene: the sharpest of its cube's pictures, or,
/// with a warning, what its irradiance coefficients say where these cannot be read. Throws InputError with
/// the JSON path of what is broken.
std::optional<Environment> loadSky(const GltfDocument& document, Warnings& warnings);

}  // namespace prelight
