#pragma once

#include "prelight/compiled_scene.h"

namespace prelight::viewer {

/// Anything but light goes around it: it is neither blended nor glass.
inline bool occludes(const CompiledMaterial& material) {
  return !material.blended && material.transmission <= 0.0f;
}

}  // namespace prelight::viewer
