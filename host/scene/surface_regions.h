#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Pieces of surface that light and photons on one of them may be averaged over without leaking round a
/// corner (Larsen 2004, 8.1).
struct SurfaceRegions {
  std::vector<std::uint32_t> regionOf;  ///< [triangle]; numbered in the order of their first triangles
  std::vector<double> areas;            ///< [region], m2

  std::uint32_t count() const { return static_cast<std::uint32_t>(areas.size()); }
};

/// Regions of surface whose neighbouring triangles meet at less than a crease angle; a planar surface meets
/// at 0. Vertices at the same place count as the same, whatever their primitives and nodes. Triangles that
/// meet with their fronts on different sides (a fold, or a turn of the winding as on a Moebius strip) do not
/// join. Where more than two triangles share an edge, every pair that continues one another joins, up to
/// 32 triangles an edge. A sliver so thin that rounding decides its normal goes to the neighbour that it
/// deviates least from, and joins no others. `creaseAngle` in radians, 0 to pi; angles within 1e-4 of it
/// count as creases.
SurfaceRegions makeSurfaceRegions(const CompiledScene& scene, double creaseAngle);

/// The regions again, cut where primitives meet: nodes that move apart then share none.
SurfaceRegions splitByPrimitive(const SurfaceRegions& regions, const CompiledScene& scene);

/// Larsen's surfaces are smooth where faces meet at less than this; rad.
constexpr double usualCreaseAngle = 0.5235987755982988;  // 30 degrees

}  // namespace prelight
