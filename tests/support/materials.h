#pragma once

#include "prelight/compiled_scene.h"

namespace prelight::test {

/// A Lambertian surface, for renderers that follow light.
CompiledMaterial lambert(float albedo);
CompiledMaterial metal(float reflectance, float roughness);
CompiledMaterial glass(float ior, bool solid);
/// A surface that transmits `share` of the light, times `color`, and reflects `base` of the rest.
CompiledMaterial translucent(float base, float share, float color);
CompiledMaterial emitter(const glm::vec3& radiance);
/// The material with a coverage of alpha.
CompiledMaterial blendedOf(CompiledMaterial material, float alpha);

}  // namespace prelight::test
