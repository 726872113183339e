#pragma once

#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Whether light passes through a material by refraction.
inline bool isGlass(const CompiledMaterial& m) {
  return !m.unlit && m.transmission > 0.0f && m.metallic < 1.0f;
}

/// Whether a material has a lobe about the mirrored direction, sharp or wide.
inline bool reflectsSpecularly(const CompiledMaterial& m) {
  return !m.unlit && (m.metallic > 0.0f || (m.specular > 0.0f && m.transmission < 1.0f));
}

/// Whether light passes through a material diffusely.
inline bool isTranslucent(const CompiledMaterial& m) { return m.diffuseTransmission != glm::vec3(0.0f); }

/// Of the light in the body of a translucent material, the share that leaves on the other side: what the
/// albedo lacks of the base colour (docs/conventions.md).
inline float translucentShare(const CompiledMaterial& m) {
  if (!isTranslucent(m)) return 0.0f;
  // A texture of metalness is in the albedo's image, not in its factor.
  const float dielectric = m.surfaceTexture.image >= 0 ? 1.0f : 1.0f - m.metallic;
  const glm::vec3 body = m.baseColor * dielectric * (1.0f - m.transmission);
  const int c = body.y > body.x ? (body.z > body.y ? 2 : 1) : (body.z > body.x ? 2 : 0);
  return body[c] > 0.0f ? glm::clamp(1.0f - m.albedo[c] / body[c], 0.0f, 1.0f) : 1.0f;
}

}  // namespace prelight
