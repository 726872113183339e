#include "gpu/surface_arrays.h"

#include <algorithm>
#include <cmath>

#include "gpu/texture_upload.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

using device::DeviceMaterial;

DeviceMaterial deviceMaterial(const CompiledMaterial& m, bool used, TextureUpload& textures) {
  DeviceMaterial d{};
  for (int c = 0; c < 3; ++c) d.albedo[c] = m.albedo[c];
  d.alphaCutoff = m.alphaCutoff;
  d.alphaFactor = m.alphaFactor;
  d.flags = surfaceFlags(m);
  d.metallic = m.metallic;
  d.glass = m.transmission;
  for (int c = 0; c < 3; ++c)
    d.transmission |=
        static_cast<std::uint32_t>(std::lround(1023.0f * std::clamp(m.diffuseTransmission[c], 0.0f, 1.0f)))
        << (10 * c);
  const auto [color, metal, glass] = used ? m.albedoTextures() : std::array<TextureRef, 3>();
  d.colorTexture = textures.add(color, true);
  d.metallicTexture = textures.add(metal, false);
  d.glassTexture = textures.add(glass, false);
  return d;
}

}  // namespace

std::uint32_t surfaceFlags(const CompiledMaterial& m) {
  return (m.blended ? PRELIGHT_BLENDED : 0u) | (isPane(m) ? PRELIGHT_PANE : 0u);
}

std::vector<bool> usedMaterials(const CompiledScene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::uint32_t material : scene.triangleMaterials) used[material] = true;
  return used;
}

SurfaceArrays makeSurfaceArrays(const CompiledScene& scene) {
  SurfaceArrays arrays;
  TextureUpload textures(scene.images);
  const std::vector<bool> used = usedMaterials(scene);
  for (std::size_t m = 0; m < used.size(); ++m)
    arrays.materials.push_back(deviceMaterial(scene.materials[m], used[m], textures));
  arrays.textures = textures.takeTextures();
  arrays.texels = textures.takeTexels();
  return arrays;
}

bool albedoHasShares(const CompiledScene& scene) {
  return std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(), [&](std::uint32_t m) {
    const auto [color, metal, glass] = scene.materials[m].albedoTextures();
    return metal.image >= 0 || glass.image >= 0;
  });
}

}  // namespace prelight
