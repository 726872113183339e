#pragma once

#include "denoise/denoiser.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"

namespace prelight {

/// Takes the noise out of a light map, chart by chart: a chart sees its own texels alone, beyond them what
/// they extrapolate to, and nothing but its own texels changes. Patches of a chart that walls part are
/// filtered apart. Throws what the denoiser does.
void denoiseLightMap(Denoiser& denoiser, const Progress& progress, LightMap& map);

}  // namespace prelight
