#include "gpu/surface_upload.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "base/octahedral.h"
#include "gpu/film_table.h"
#include "gpu/scene_albedos.h"
#include "gpu/surface_arrays.h"
#include "gpu/texture_upload.h"
#include "scene/lobes.h"
#include "scene/tangent_space.h"
#include "shared/measured_types.h"

namespace prelight {

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
