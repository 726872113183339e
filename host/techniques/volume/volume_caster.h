#pragma once

#include <cstdint>

#include "cast/caster.h"
#include "gpu/tracer.h"
#include "prelight/progress.h"
#include "prelight/transfer.h"
#include "techniques/slot_transfer.h"

namespace prelight {

struct VolumeOptions {
  int order = 3;             ///< bands; at most that of the surface's transfer when there are bounces
  int bounces = 0;           ///< 0: what surfaces reflect is left out
  bool lights = false;       ///< keep what surfaces reflect of the groups of lights, too
  std::uint32_t rays = 256;  ///< a voxel, a power of two, 8 and more
  std::uint64_t seed = 0;
  OcclusionLimits limits;
};

/// Casts from the centres of a grid's cells. `surface` is the fit's transfer with bounces; read only when
/// options.bounces is above 0. Voxels that see nothing but backs are dark and are not air.
VolumeTransfer makeVolume(const CompiledScene& scene, const FitMesh& mesh, Tracer& tracer,
                          const SlotTransfer& surface, const VolumeGrid& grid, const VolumeOptions& options,
                          Progress& progress);

}  // namespace prelight
