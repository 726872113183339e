#pragma once

#include "scene/compiled_scene.h"

namespace prelight::test {

/// Lambertian surface of an albedo, for all that follows light.
CompiledMaterial lambert(float albedo);
CompiledMaterial metal(float reflectance, float roughness);
CompiledMaterial glass(float ior, bool solid);
CompiledMaterial emitter(const glm::vec3& radiance);

}  // namespace prelight::test
