#pragma once

#include <cstddef>
#include <filesystem>

#include "prelight/light_map.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Throws Error (RuntimeFailure) naming the place when an accessor from `firstAccessor` on holds numbers that
/// readers refuse: not finite, or beyond largestBaked.
void requireFiniteBake(const GltfDocument& document, std::size_t firstAccessor);

/// Throws Error (RuntimeFailure) for such numbers in a light map that is written to `path`.
void requireFiniteLightMap(const std::filesystem::path& path, const LightMap& map);

/// Throws Error (RuntimeFailure) naming the pixel for such numbers in a picture.
void requireFinite(const std::filesystem::path& path, const Picture& picture);

}  // namespace prelight
