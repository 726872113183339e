#pragma once

#include <cstddef>
#include <filesystem>

#include "prelight/light_map.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Throws Error (RuntimeFailure) naming the place when an accessor from `firstAccessor` on holds numbers that
/// a reader of the bake would refuse: not finite, or beyond largestBaked.
void requireFiniteBake(const GltfDocument& document, std::size_t firstAccessor);

/// The same for a light map's values, which are written to `path`.
void requireFiniteLightMap(const std::filesystem::path& path, const LightMap& map);

/// The same for a picture, naming the pixel.
void requireFinite(const std::filesystem::path& path, const Picture& picture);

}  // namespace prelight
