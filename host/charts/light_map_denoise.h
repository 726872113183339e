#pragma once

#include "denoise/denoiser.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"

namespace prelight {

/// Removes noise from a light map, chart by chart: a chart's image holds its own texels and their
/// extrapolation beyond them, and only its own texels are changed. Patches of a chart that walls divide are
/// filtered separately. Throws what the denoiser throws.
void denoiseLightMap(Denoiser& denoiser, const Progress& progress, LightMap& map);

}  // namespace prelight
