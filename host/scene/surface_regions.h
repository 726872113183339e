#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Pieces of surface over which light and photons may be averaged without leaking round a corner (Larsen
/// 2004, 8.1).
struct SurfaceRegions {
  std::vector<std::uint32_t> regionOf;  ///< [triangle]; numbered in the order of their first triangles
  std::vector<double> areas;            ///< [region], m2

  std::uint32_t count() const { return static_cast<std::uint32_t>(areas.size()); }
};

/// Returns the regions of surface whose neighbouring triangles meet at less than a crease angle; a planar
/// surface meets at 0. Vertices at the same position count as one, whatever their primitives and nodes.
/// Triangles whose fronts are on different sides (a fold, or reversed winding as on a Moebius strip) are not
/// joined. Where more than two triangles share an edge, every two of them that continue one another are
/// joined, up to 32 triangles per edge. A sliver so thin that rounding determines its normal is assigned to
/// the neighbour from which it deviates least, and joins no others. `creaseAngle` is in radians, 0 to pi;
/// angles within 1e-4 of it count as creases.
SurfaceRegions makeSurfaceRegions(const CompiledScene& scene, double creaseAngle);

/// Returns the regions cut where primitives meet, so that nodes that move apart share none.
SurfaceRegions splitByPrimitive(const SurfaceRegions& regions, const CompiledScene& scene);

/// Default crease angle of Larsen's regions, rad.
constexpr double usualCreaseAngle = 0.5235987755982988;  // 30 degrees

}  // namespace prelight
