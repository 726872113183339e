#pragma once

#include <glm/glm.hpp>
#include <span>

#include "photon/density_surface.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Lessens irradiance from photon densities, [texel of the layout] W/m2, at texels that stand for more
/// surface than the region whose photons they count: the photons of such a region light a part of the texel
/// alone, and few as they are, their density may be that of a lamp's surface. `spacing`: distance of
/// neighbouring texels, m.
void lessenSmallRegions(const CompiledScene& scene, const DensitySurface& surface,
                        const LightMapLayout& layout, double spacing, std::span<glm::vec3> irradiance);

}  // namespace prelight
