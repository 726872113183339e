#pragma once

#include <span>
#include <vector>

#include "benchmarks/seen_places.h"

namespace prelight::benchmarks {

/// Irradiance of a lamp at places, luminance, with the shadows of traced rays: of an area light, of `samples`
/// patches. 0 where nothing is seen.
std::vector<double> tracedIrradiance(const CompiledScene& scene, Tracer& tracer,
                                     std::span<const SeenPlace> places, const Light& lamp, int samples);

}  // namespace prelight::benchmarks
