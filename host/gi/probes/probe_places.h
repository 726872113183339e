#pragma once

#include "gi/probes/irradiance_volume.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"

namespace prelight {

/// What probes' rays say of their surroundings.
struct ProbePlacement {
  std::size_t moved = 0;   ///< out of objects
  std::size_t inside = 0;  ///< that stay there and are not valid
};

/// Sets the places of a volume's probes, whether they are valid, and their surfaces; the grid is there. A
/// probe that sees backs of one-sided surfaces in a quarter of all directions and more lies in an object: it
/// moves through the nearest of them, by half a cell at most, or is not valid.
ProbePlacement placeProbes(const CompiledScene& scene, Tracer& tracer, IrradianceVolume& volume,
                           Progress& progress);

}  // namespace prelight
