#include "gpu/surface_upload.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "base/directions.h"
#include "gpu/albedo_table.h"
#include "gpu/film_table.h"
#include "scene/compile/compile_parts.h"
#include "scene/lobes.h"
#include "scene/surface/tangent_space.h"
#include "shared/measured_types.h"

namespace prelight {

namespace {

/// [byte], value in 1/65535.
using SharesOfBytes = std::array<std::uint16_t, 256>;

SharesOfBytes sharesOfBytes(bool srgb) {
  SharesOfBytes shares{};
  for (std::size_t byte = 0; byte < shares.size(); ++byte)
    shares[byte] = static_cast<std::uint16_t>(
        srgb ? std::lround(65535.0f * linearFromSrgb(static_cast<std::uint8_t>(byte)))
             : static_cast<long>(257 * byte));
  return shares;
}

}  // namespace

std::uint32_t TextureUpload::add(const TextureRef& use, bool srgb) {
  if (use.image < 0) return PRELIGHT_NO_TEXTURE;
  const Image& image = images_[static_cast<std::size_t>(use.image)];
  device::DeviceTexture t{};
  for (int c = 0; c < 3; ++c) {
    t.u[c] = use.transform[c][0];
    t.v[c] = use.transform[c][1];
  }
  t.texelOffset = texelsOf(use.image, srgb);
  t.flags = (use.filter == TextureFilter::Nearest ? PRELIGHT_NEAREST : 0u) |
            (use.texCoord == 1 ? PRELIGHT_SECOND_SET : 0u);
  t.width = static_cast<std::uint32_t>(image.width);
  t.height = static_cast<std::uint32_t>(image.height);
  t.wrapS = deviceWrap(use.wrapS);
  t.wrapT = deviceWrap(use.wrapT);
  textures_.push_back(t);
  return static_cast<std::uint32_t>(textures_.size() - 1);
}

std::uint32_t TextureUpload::texelsOf(int index, bool srgb) {
  const auto [found, isNew] = offsets_.try_emplace({index, srgb}, static_cast<std::uint32_t>(texels_.size()));
  if (!isNew) return found->second;
  const std::vector<std::uint8_t>& rgba = images_[static_cast<std::size_t>(index)].rgba;
  const SharesOfBytes alpha = sharesOfBytes(false), colour = sharesOfBytes(srgb);
  texels_.reserve(texels_.size() + rgba.size() / 4);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
    texels_.emplace_back(colour[rgba[i]], colour[rgba[i + 1]], colour[rgba[i + 2]], alpha[rgba[i + 3]]);
  return found->second;
}

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

namespace {

using device::DeviceMaterial;
using device::ShadeMaterial;

/// Bound on radiance, above anything physical, below which no product along a path exceeds the range of
/// floats.
constexpr float brightest = 1e12f;

/// Sets the reflectance of a dielectric along its normal, modified by KHR_materials_specular.
void setSpecular(const CompiledMaterial& m, ShadeMaterial& r) {
  const float root = m.ior == 0.0f ? 1.0f : (m.ior - 1.0f) / (m.ior + 1.0f);
  for (int c = 0; c < 3; ++c) r.f0[c] = root * root * m.specularColor[c];
  r.specular = m.specular;
}

DeviceMaterial baseMaterial(const CompiledMaterial& m, std::uint32_t texture) {
  DeviceMaterial d{};
  for (int c = 0; c < 3; ++c) d.albedo[c] = m.baseColor[c];
  d.alphaCutoff = m.alphaCutoff;
  d.alphaFactor = m.alphaFactor;
  d.flags = surfaceFlags(m);
  d.colorTexture = texture;
  d.metallicTexture = d.glassTexture = PRELIGHT_NO_TEXTURE;
  return d;
}

ShadeMaterial shadeMaterial(const CompiledMaterial& m) {
  ShadeMaterial r{};
  for (int c = 0; c < 3; ++c) {
    r.absorption[c] = m.absorption[c];
    r.scattering[c] = m.scattering[c];
    r.emission[c] = std::min(m.emission[c], brightest);
    r.through[c] = m.translucentColor[c];
    r.sheen[c] = m.sheen.color[c];
  }
  if (!m.unlit && !hasMeasuredLobe(m)) setSpecular(m, r);
  r.ior = m.ior;
  r.metallic = m.metallic;
  r.roughness = m.roughness;
  r.transmission = m.transmission;
  r.throughShare = m.translucency;
  r.normalScale = m.normalScale;
  r.sheenRoughness = m.sheen.roughness;
  r.coat = m.clearcoat.factor;
  r.coatRoughness = m.clearcoat.roughness;
  r.coatNormalScale = m.clearcoat.normalScale;
  r.film = hasFilm(m) ? m.iridescence.factor : 0.0f;
  r.filmIor = m.iridescence.ior;
  r.filmThickness[0] = filmThicknesses(m).x;
  r.filmThickness[1] = filmThicknesses(m).y;
  r.dispersion = m.dispersion;
  r.scatterAnisotropy = m.scatterAnisotropy;
  r.anisotropy = isAnisotropic(m) ? m.anisotropy.strength : 0.0f;
  r.anisotropyTurn[0] = std::cos(m.anisotropy.rotation);
  r.anisotropyTurn[1] = std::sin(m.anisotropy.rotation);
  r.measured = PRELIGHT_NO_MEASURED;
  r.flags = (m.solid ? PRELIGHT_SOLID : 0u) | (m.doubleSided ? PRELIGHT_DOUBLE_SIDED : 0u) |
            (m.unlit ? PRELIGHT_UNLIT : 0u);
  std::fill(std::begin(r.textures), std::end(r.textures), PRELIGHT_NO_TEXTURE);
  return r;
}

void addTextures(const CompiledMaterial& m, TextureUpload& upload, ShadeMaterial& r) {
  r.textures[PRELIGHT_SURFACE_TEXTURE] = upload.add(m.surfaceTexture, false);
  r.textures[PRELIGHT_EMISSION_TEXTURE] = upload.add(m.emissionTexture, true);
  r.textures[PRELIGHT_GLASS_TEXTURE] = upload.add(m.transmissionTexture, false);
  r.textures[PRELIGHT_SPECULAR_TEXTURE] = upload.add(m.specularTexture, false);
  r.textures[PRELIGHT_SPECULAR_COLOR_TEXTURE] = upload.add(m.specularColorTexture, true);
  r.textures[PRELIGHT_THROUGH_TEXTURE] = upload.add(m.translucencyTexture, false);
  r.textures[PRELIGHT_THROUGH_COLOR_TEXTURE] = upload.add(m.translucentColorTexture, true);
  r.textures[PRELIGHT_NORMAL_TEXTURE] = upload.add(m.normalTexture, false);
  r.textures[PRELIGHT_COAT_TEXTURE] = upload.add(m.clearcoat.texture, false);
  r.textures[PRELIGHT_COAT_ROUGHNESS_TEXTURE] = upload.add(m.clearcoat.roughnessTexture, false);
  r.textures[PRELIGHT_SHEEN_COLOR_TEXTURE] = upload.add(m.sheen.colorTexture, true);
  r.textures[PRELIGHT_SHEEN_ROUGHNESS_TEXTURE] = upload.add(m.sheen.roughnessTexture, false);
  r.textures[PRELIGHT_COAT_NORMAL_TEXTURE] = upload.add(m.clearcoat.normalTexture, false);
  r.textures[PRELIGHT_FILM_TEXTURE] = upload.add(m.iridescence.texture, false);
  r.textures[PRELIGHT_FILM_THICKNESS_TEXTURE] = upload.add(m.iridescence.thicknessTexture, false);
  r.textures[PRELIGHT_ANISOTROPY_TEXTURE] = upload.add(m.anisotropy.texture, false);
}

/// Adds the look-up tables of lobes for the materials of `used`.
void addAlbedos(const CompiledScene& scene, const std::vector<bool>& used, ShadeArrays& arrays) {
  bool rough = false;
  for (std::size_t i = 0; i < used.size(); ++i)
    rough = rough || (used[i] && mayReflectRoughly(scene.materials[i]));
  if (!rough) return;
  SceneAlbedos albedos = makeSceneAlbedos(scene, used);
  arrays.albedos = std::move(albedos.texels);
  for (std::size_t i = 0; i < used.size(); ++i) {
    arrays.materials[i].glassTable = albedos.glassTables[i];
    arrays.materials[i].filmTable = albedos.filmTables[i];
  }
}

/// Adds the tables of measured materials; materials with the same BRDF share one.
void addMeasured(const CompiledScene& scene, const std::vector<bool>& used, ShadeArrays& arrays) {
  static_assert(MeasuredBrdf::halves == PRELIGHT_MEASURED_HALVES &&
                MeasuredBrdf::turns == PRELIGHT_MEASURED_TURNS &&
                MeasuredBrdf::differences == PRELIGHT_MEASURED_DIFFERENCES &&
                MeasuredBrdf::cosines == PRELIGHT_MEASURED_COSINES);
  std::map<const MeasuredBrdf*, std::uint32_t> places;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i] || !hasMeasuredLobe(scene.materials[i])) continue;
    const MeasuredBrdf& brdf = *scene.materials[i].measured;
    const auto [place, isNew] = places.try_emplace(&brdf, static_cast<std::uint32_t>(arrays.measured.size()));
    if (isNew)
      for (const std::vector<glm::vec3>* part : {&brdf.albedos, &brdf.rest})
        for (const glm::vec3& v : *part) arrays.measured.insert(arrays.measured.end(), {v.x, v.y, v.z});
    arrays.materials[i].measured = place->second;
    arrays.materials[i].measuredShare = brdf.cosineShare;
  }
}

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

std::vector<std::uint32_t> packTangents(const CompiledScene& scene) {
  std::vector<std::uint32_t> packed;
  if (!scene.needsTangents()) return packed;
  constexpr std::uint32_t mirrored = 0x10000u;
  for (const glm::vec4& tangent : cornerTangents(scene))
    packed.push_back((packDirection(glm::dvec3(tangent)) & ~mirrored) | (tangent.w < 0.0f ? mirrored : 0u));
  return packed;
}

namespace {

/// Returns a material without the textures that do not affect how light passes a pane.
CompiledMaterial paneAlone(CompiledMaterial m) {
  m.emissionTexture = m.translucencyTexture = m.translucentColorTexture = m.anisotropy.texture = {};
  return m;
}

/// Makes the arrays. Materials that are not `used` have no textures.
ShadeArrays shadeArraysOf(const CompiledScene& scene, std::span<const CompiledMaterial> materials,
                          const std::vector<Image>& images, const std::vector<bool>& used) {
  ShadeArrays arrays;
  TextureUpload upload(images);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const CompiledMaterial& m = materials[i];
    arrays.bases.push_back(
        baseMaterial(m, used[i] ? upload.add(m.baseColorTexture, true) : PRELIGHT_NO_TEXTURE));
    arrays.materials.push_back(shadeMaterial(m));
    if (used[i]) addTextures(m, upload, arrays.materials.back());
  }
  arrays.textures = upload.takeTextures();
  arrays.texels = upload.takeTexels();
  addAlbedos(scene, used, arrays);
  addMeasured(scene, used, arrays);
  return arrays;
}

}  // namespace

ShadeArrays makePlainShadeArrays(const CompiledScene& scene) {
  ShadeArrays arrays;
  for (const CompiledMaterial& m : scene.materials) {
    arrays.bases.push_back(baseMaterial(m, PRELIGHT_NO_TEXTURE));
    arrays.materials.push_back(shadeMaterial(m));
  }
  const std::vector<bool> used = usedMaterials(scene);
  addAlbedos(scene, used, arrays);
  addMeasured(scene, used, arrays);
  return arrays;
}

ShadeArrays makeShadeArrays(const CompiledScene& scene, const std::vector<Image>& images) {
  return shadeArraysOf(scene, scene.materials, images, usedMaterials(scene));
}

ShadeArrays makePaneArrays(const CompiledScene& scene) {
  std::vector<bool> panes = usedMaterials(scene);
  std::vector<CompiledMaterial> materials;
  for (std::size_t m = 0; m < panes.size(); ++m) {
    panes[m] = panes[m] && isPane(scene.materials[m]);
    materials.push_back(paneAlone(scene.materials[m]));
  }
  return shadeArraysOf(scene, materials, scene.images, panes);
}

}  // namespace prelight
