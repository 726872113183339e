#pragma once

#include <glm/glm.hpp>
#include <span>

#include "prelight/light_map.h"

namespace prelight {

/// Adds to the irradiance of a layout's texels, [texel of the layout] W/m2, what few of their rays have
/// brought in excess (BoundedIrradiance), spread over the texels around in the same patch (wallPatches()).
/// The sum over a patch's texels stays, except in patches of fewer than sixteen texels within reach, which
/// keep less the fewer they are: there is nobody to share with.
void spreadExcess(const LightMapLayout& layout, std::span<const glm::vec3> excess,
                  std::span<glm::vec3> irradiance);

}  // namespace prelight
