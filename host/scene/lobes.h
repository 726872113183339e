#pragma once

#include "scene/compiled_scene.h"

namespace prelight {

/// Whether light passes through a material by refraction.
inline bool isGlass(const CompiledMaterial& m) {
  return !m.unlit && m.transmission > 0.0f && m.metallic < 1.0f;
}

/// Whether a material has a lobe about the mirrored direction, sharp or wide.
inline bool reflectsSpecularly(const CompiledMaterial& m) {
  return !m.unlit && (m.metallic > 0.0f || (m.specular > 0.0f && m.transmission < 1.0f));
}

}  // namespace prelight
