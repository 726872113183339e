#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cast/caster.h"
#include "cast/hemisphere_column.h"
#include "cast/specular_column.h"
#include "cast/stored_transport.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "prelight/progress.h"
#include "prelight/transfer.h"
#include "techniques/slot_transfer.h"
#include "scene/gltf/charts.h"

namespace prelight {

struct ChartTransferOptions {
  int order = 3;              ///< bands; at most that of the surface's transfer when there are bounces
  int bounces = 0;            ///< 0: what surfaces reflect is left out
  std::uint32_t rays = 1024;  ///< a texel, a power of two, 16 to 4096
  std::uint64_t seed = 0;
  OcclusionLimits limits;
  SpecularWays specular = {};         ///< with as many bands, where they are followed
  const ShadowSets* sets = nullptr;   ///< nullptr: all see everything
  std::span<Tracer> setTracers = {};  ///< [set - 1]
  bool relief = false;                ///< bumps of normal textures shadow one another
};

/// What casting from charts did.
struct ChartTransferReport {
  std::uint64_t rays = 0;
  std::uint64_t texels = 0;  ///< that the surface reaches
  std::uint64_t hidden = 0;  ///< receivers inside objects, which count for nothing
};

/// Casts from the texels of charts. `surface` is the fit's transfer with bounces; read only when
/// options.bounces is above 0. Receivers inside closed one-sided objects are left out, and texels without any
/// other take after their neighbours: what nobody sees does not darken what is beside it.
ChartTransfer makeChartTransfer(const CompiledScene& scene, const Charts& charts, const FitMesh& mesh,
                                Tracer& tracer, const SlotTransfer& surface,
                                const ChartTransferOptions& options, Progress& progress,
                                ChartTransferReport& report);

}  // namespace prelight
