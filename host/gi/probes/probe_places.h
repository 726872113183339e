#pragma once

#include "gi/probes/irradiance_volume.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"

namespace prelight {

/// Statistics of placing probes.
struct ProbePlacement {
  std::size_t moved = 0;   ///< moved out of objects
  std::size_t inside = 0;  ///< stayed inside and are not valid
};

/// Sets the places of a volume's probes, whether they are valid, and their surfaces. The grid must be set. A
/// probe that sees backs of one-sided surfaces in at least a quarter of all directions lies in an object: it
/// is moved through the nearest back, by at most half a cell, or is not valid.
ProbePlacement placeProbes(const CompiledScene& scene, Tracer& tracer, IrradianceVolume& volume,
                           Progress& progress);

}  // namespace prelight
