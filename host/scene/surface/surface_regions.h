#pragma once

#include <cstdint>
#include <span>
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

/// The connected parts of a primitive's triangles.
struct SurfaceParts {
  std::vector<std::uint32_t> partOf;     ///< [triangle of the primitive]
  std::vector<std::uint32_t> triangles;  ///< triangles of the primitive, grouped by part
  std::vector<std::uint32_t> first;      ///< [part] index of its first triangle in `triangles`, then the end

  std::uint32_t count() const { return static_cast<std::uint32_t>(first.size()) - 1; }

  /// Returns the triangles of a part in ascending order.
  std::span<const std::uint32_t> trianglesOf(std::uint32_t part) const {
    return std::span(triangles).subspan(first[part], first[part + 1] - first[part]);
  }
};

/// Returns the parts of a primitive. Triangles are connected if they share a vertex, or an edge that no third
/// triangle has and along which they run in opposite directions; for edges, vertices at exactly the same
/// position count as one.
SurfaceParts surfaceParts(const CompiledScene& scene, const PrimitiveRange& range);

}  // namespace prelight
