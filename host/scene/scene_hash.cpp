#include "scene/scene_hash.h"

#include "scene/light_profile.h"

namespace prelight {

void addLight(const Light& light, StateHash& hash) {
  hash.value(light.type).value(light.range);
  hash.value(light.innerConeAngle).value(light.outerConeAngle);
  for (int c = 0; c < 3; ++c)
    hash.value(light.intensity[c]).value(light.position[c]).value(light.direction[c]);
  if (light.radius > 0.0f) hash.value(light.radius);
  if (light.profile != nullptr) addProfile(light, hash);
}

namespace {

void addVector(StateHash& hash, const glm::dvec3& v) { hash.value(v.x).value(v.y).value(v.z); }

void addTexture(StateHash& hash, const TextureRef& texture) {
  for (const int v : {texture.image, texture.texCoord, static_cast<int>(texture.wrapS),
                      static_cast<int>(texture.wrapT), static_cast<int>(texture.filter)})
    hash.value(v);
  for (int c = 0; c < 3; ++c) addVector(hash, glm::dvec3(texture.transform[c]));
}

}  // namespace

void addMaterial(const CompiledMaterial& m, StateHash& hash) {
  for (const glm::vec3& v : {m.albedo, m.diffuseTransmission, m.baseColor, m.emission, m.absorption,
                             m.specularColor, m.translucentColor, m.sheen.color, m.scattering})
    addVector(hash, glm::dvec3(v));
  for (const float v : {m.alphaCutoff,
                        m.alphaFactor,
                        m.metallic,
                        m.roughness,
                        m.transmission,
                        m.ior,
                        m.specular,
                        m.translucency,
                        m.normalScale,
                        m.clearcoat.factor,
                        m.clearcoat.roughness,
                        m.clearcoat.normalScale,
                        m.sheen.roughness,
                        m.anisotropy.strength,
                        m.anisotropy.rotation,
                        m.iridescence.factor,
                        m.iridescence.ior,
                        m.iridescence.thicknessMinimum,
                        m.iridescence.thicknessMaximum,
                        m.dispersion,
                        m.scatterAnisotropy})
    hash.value(v);
  for (const bool v : {m.doubleSided, m.blended, m.solid, m.unlit}) hash.value(v ? 1 : 0);
  for (const TextureRef& texture : m.textures()) addTexture(hash, texture);
  if (m.measured != nullptr) hash.values(m.measured->rest);
}

}  // namespace prelight
