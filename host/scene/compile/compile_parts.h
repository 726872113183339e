#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/scene.h"

namespace prelight {

/// Materials of the flat scene and, for each, where its texture coordinates come from.
struct CompiledMaterials {
  std::vector<CompiledMaterial> materials;  ///< Scene::materials, then the default one
  std::vector<TextureRef> coordinates;      ///< [material], `image` < 0 when it has no albedo image
  std::vector<Image> albedoImages;
};

CompiledMaterials compileMaterials(const Scene& scene, Warnings& warnings);

/// Adds the meshes of a flattened scene that are drawn more than once, and where.
void findShapes(const Scene& scene, CompiledScene& compiled);

/// sRGB byte to linear [0,1] and back.
float linearFromSrgb(std::uint8_t value);
std::uint8_t srgbFromLinear(float value);

}  // namespace prelight
