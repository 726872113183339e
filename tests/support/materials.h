#pragma once

#include "prelight/compiled_scene.h"

namespace prelight::test {

/// Lambertian surface of an albedo, for all that follows light.
CompiledMaterial lambert(float albedo);
CompiledMaterial metal(float reflectance, float roughness);
CompiledMaterial glass(float ior, bool solid);
/// Of the light that arrives, lets `share` through, which becomes `color` of that, and reflects `base` of the
/// rest.
CompiledMaterial translucent(float base, float share, float color);
CompiledMaterial emitter(const glm::vec3& radiance);
/// There for the share alpha of the rays.
CompiledMaterial blendedOf(CompiledMaterial material, float alpha);

}  // namespace prelight::test
