#include "gpu/surface_arrays.h"

#include <algorithm>
#include <cmath>

#include "scene/compile/compile_parts.h"
#include "scene/compile/device_wrap.h"

namespace prelight {

namespace {

using device::DeviceMaterial;

glm::u16vec4 linearTexel(const std::uint8_t* srgb) {
  const glm::vec3 linear(linearFromSrgb(srgb[0]), linearFromSrgb(srgb[1]), linearFromSrgb(srgb[2]));
  return {glm::u16vec3(glm::round(65535.0f * linear)), static_cast<std::uint16_t>(257 * srgb[3])};
}

DeviceMaterial deviceMaterial(const CompiledMaterial& m, const std::vector<Image>& images,
                              const std::vector<std::uint32_t>& offsets, bool used) {
  DeviceMaterial d{};
  for (int c = 0; c < 3; ++c) d.albedo[c] = m.albedo[c];
  d.alphaCutoff = m.alphaCutoff;
  d.alphaFactor = m.alphaFactor;
  for (int c = 0; c < 3; ++c)
    d.transmission |=
        static_cast<std::uint32_t>(std::lround(1023.0f * std::clamp(m.diffuseTransmission[c], 0.0f, 1.0f)))
        << (10 * c);
  d.texelOffset = PRELIGHT_NO_TEXTURE;
  d.wrapS = deviceWrap(m.wrapS);
  d.wrapT = deviceWrap(m.wrapT);
  if (used && m.albedoImage >= 0) {
    const auto image = static_cast<std::size_t>(m.albedoImage);
    d.texelOffset = offsets[image];
    d.width = static_cast<std::uint32_t>(images[image].width);
    d.height = static_cast<std::uint32_t>(images[image].height);
  }
  return d;
}

}  // namespace

std::vector<bool> usedMaterials(const CompiledScene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::uint32_t material : scene.triangleMaterials) used[material] = true;
  return used;
}

SurfaceArrays makeSurfaceArrays(const CompiledScene& scene) {
  SurfaceArrays arrays;
  const std::vector<bool> used = usedMaterials(scene);
  std::vector<bool> lookedUp(scene.albedoImages.size(), false);
  for (std::size_t m = 0; m < used.size(); ++m)
    if (const int image = scene.materials[m].albedoImage; used[m] && image >= 0)
      lookedUp[static_cast<std::size_t>(image)] = true;
  std::vector<std::uint32_t> offsets;
  for (std::size_t index = 0; index < lookedUp.size(); ++index) {
    const Image& image = scene.albedoImages[index];
    offsets.push_back(static_cast<std::uint32_t>(arrays.texels.size()));
    for (std::size_t i = 0; lookedUp[index] && i + 3 < image.rgba.size(); i += 4)
      arrays.texels.push_back(linearTexel(&image.rgba[i]));
  }
  for (std::size_t m = 0; m < used.size(); ++m)
    arrays.materials.push_back(deviceMaterial(scene.materials[m], scene.albedoImages, offsets, used[m]));
  return arrays;
}

}  // namespace prelight
