#pragma once

#include <optional>

#include "prelight/error.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns the sky of the document's scene (EXT_lights_image_based): the sharpest of its cube maps or, with a
/// warning where its images cannot be read, the sky of its irradiance coefficients. Throws InputError with
/// the JSON path of a broken part.
std::optional<Environment> loadSky(const GltfDocument& document, Warnings& warnings);

}  // namespace prelight
