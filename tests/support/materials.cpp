#include "support/materials.h"

namespace prelight::test {

CompiledMaterial lambert(float albedo) {
  CompiledMaterial m;
  m.albedo = m.baseColor = glm::vec3(albedo);
  return m;
}

CompiledMaterial metal(float reflectance, float roughness) {
  CompiledMaterial m;
  m.baseColor = glm::vec3(reflectance);
  m.metallic = 1.0f;
  m.roughness = roughness;
  return m;
}

CompiledMaterial glass(float ior, bool solid) {
  CompiledMaterial m;
  m.baseColor = glm::vec3(1.0f);
  m.transmission = 1.0f;
  m.specular = 1.0f;
  m.roughness = 0.0f;
  m.ior = ior;
  m.solid = solid;
  return m;
}

CompiledMaterial translucent(float base, float share, float color) {
  CompiledMaterial m = lambert(base);
  m.albedo *= 1.0f - share;
  m.diffuseTransmission = glm::vec3(share * color);
  m.translucency = m.meanTranslucency = share;
  m.translucentColor = glm::vec3(color);
  return m;
}

CompiledMaterial emitter(const glm::vec3& radiance) {
  CompiledMaterial m = lambert(0.0f);
  m.emission = radiance;
  return m;
}

CompiledMaterial blendedOf(CompiledMaterial material, float alpha) {
  material.alphaCutoff = 0.5f;
  material.alphaFactor = alpha;
  material.blended = true;
  return material;
}

}  // namespace prelight::test
