#include "gpu/surface_upload.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "gpu/surface_arrays.h"
#include "scene/compile/compile_parts.h"
#include "scene/compile/device_wrap.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

using device::DeviceMaterial;
using device::ShadeMaterial;

/// Radiance beyond this is no light of this world; below, no product along a path leaves float's range.
constexpr float brightest = 1e12f;

void setTexture(DeviceMaterial& d, const Image& image, std::uint32_t offset, WrapMode s, WrapMode t) {
  d.texelOffset = offset;
  d.width = static_cast<std::uint32_t>(image.width);
  d.height = static_cast<std::uint32_t>(image.height);
  d.wrapS = deviceWrap(s);
  d.wrapT = deviceWrap(t);
}

DeviceMaterial untextured() {
  DeviceMaterial d{};
  for (float& channel : d.albedo) channel = 1.0f;
  d.alphaCutoff = -1.0f;
  d.alphaFactor = 1.0f;
  d.texelOffset = PRELIGHT_NO_TEXTURE;
  return d;
}

/// Reflectance of a dielectric along its normal, and what KHR_materials_specular makes of it.
void setSpecular(const CompiledMaterial& m, ShadeMaterial& r) {
  const float root = m.ior == 0.0f ? 1.0f : (m.ior - 1.0f) / (m.ior + 1.0f);
  for (int c = 0; c < 3; ++c) r.f0[c] = m.specular * std::min(root * root * m.specularColor[c], 1.0f);
  r.f90 = m.specular;
}

DeviceMaterial throughLayer(const CompiledMaterial& m) {
  DeviceMaterial d = untextured();
  for (int c = 0; c < 3; ++c) d.albedo[c] = m.diffuseTransmission[c];
  d.alphaFactor = translucentShare(m);
  return d;
}

class LayerUpload {
 public:
  explicit LayerUpload(const std::vector<Image>& images) : images_(images) {}

  DeviceMaterial add(const LayerTexture& texture, bool srgb) {
    DeviceMaterial d = untextured();
    if (texture.image < 0) return d;
    const Image& image = images_[static_cast<std::size_t>(texture.image)];
    const auto [found, isNew] =
        offsets_.try_emplace({texture.image, srgb}, static_cast<std::uint32_t>(texels_.size()));
    if (isNew) addTexels(image, srgb);
    setTexture(d, image, found->second, texture.wrapS, texture.wrapT);
    return d;
  }

  std::vector<glm::u16vec4> take() { return std::move(texels_); }

 private:
  void addTexels(const Image& image, bool srgb) {
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
      glm::u16vec4 texel(0);
      for (int c = 0; c < 4; ++c) {
        const std::uint8_t byte = image.rgba[i + static_cast<std::size_t>(c)];
        texel[c] = srgb && c < 3 ? static_cast<std::uint16_t>(std::lround(65535.0f * linearFromSrgb(byte)))
                                 : static_cast<std::uint16_t>(257 * byte);
      }
      texels_.push_back(texel);
    }
  }

  const std::vector<Image>& images_;
  std::map<std::pair<int, bool>, std::uint32_t> offsets_;
  std::vector<glm::u16vec4> texels_;
};

}  // namespace

std::vector<float> interleaveVertices(const CompiledScene& scene) {
  std::vector<float> values;
  values.reserve(6 * std::size_t{scene.vertexCount()});
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 &p = scene.positions[v], &n = scene.normals[v];
    values.insert(values.end(), {p.x, p.y, p.z, n.x, n.y, n.z});
  }
  return values;
}

std::vector<DeviceMaterial> makeBaseMaterials(const CompiledScene& scene) {
  std::vector<DeviceMaterial> materials;
  for (const CompiledMaterial& m : scene.materials) {
    materials.push_back(untextured());
    for (int c = 0; c < 3; ++c) materials.back().albedo[c] = m.baseColor[c];
  }
  return materials;
}

std::vector<ShadeMaterial> makeShadeMaterials(const CompiledScene& scene, bool textured) {
  std::vector<ShadeMaterial> materials;
  for (const CompiledMaterial& m : scene.materials) {
    ShadeMaterial r{};
    const glm::vec3 emission = textured ? m.emissionFactor : m.emission;
    for (int c = 0; c < 3; ++c) {
      r.absorption[c] = m.absorption[c];
      r.emission[c] = std::min(emission[c], brightest);
    }
    if (!m.unlit) setSpecular(m, r);
    r.ior = m.ior;
    r.metallic = m.metallic;
    r.roughness = m.roughness;
    r.transmission = m.transmission;
    r.flags = (m.solid ? PRELIGHT_SOLID : 0u) | (m.doubleSided ? PRELIGHT_DOUBLE_SIDED : 0u) |
              (m.unlit ? PRELIGHT_UNLIT : 0u);
    materials.push_back(r);
  }
  return materials;
}

Layers makeLayers(const CompiledScene& scene, const std::vector<Image>& images) {
  LayerUpload upload(images);
  const std::vector<bool> used = usedMaterials(scene);
  Layers layers;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const CompiledMaterial& m = scene.materials[i];
    const auto layerOf = [&](const LayerTexture& texture, bool srgb) {
      return upload.add(used[i] ? texture : LayerTexture{}, srgb);
    };
    layers.materials.push_back(layerOf(m.baseColorTexture, true));
    layers.materials.push_back(layerOf(m.surfaceTexture, false));
    layers.materials.push_back(layerOf(m.emissionTexture, true));
    layers.materials.push_back(throughLayer(m));
  }
  layers.texels = upload.take();
  return layers;
}

}  // namespace prelight
