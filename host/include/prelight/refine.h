#pragma once

#include <cstddef>
#include <cstdint>

#include "prelight/load.h"

namespace prelight {

class Device;
class Progress;

/// Subdivision of triangles between whose vertices light changes faster than interpolation can follow.
struct RefineRequest {
  /// Light that linear interpolation over a triangle may lose: rms over the triangle, as a share of the light
  /// of an open sky. 0: nothing is subdivided.
  double error = 0.0;
  std::uint64_t vertices = std::uint64_t{1} << 16;  ///< most vertices to add, counted once per instance

  explicit operator bool() const { return error > 0.0; }
};

/// Statistics of a refinement.
struct RefineReport {
  std::uint64_t vertices = 0;   ///< vertices that were added, counted once per instance of their mesh
  std::uint64_t triangles = 0;  ///< triangles that were added, likewise
  std::size_t primitives = 0;   ///< primitives that were subdivided
  double errorBefore = 0.0;     ///< estimated error before, rms over the surface
  double error = 0.0;           ///< estimated error afterwards, rms over the surface
  double leastEdge = 0.0;       ///< m; edges are not cut that are shorter than twice this
  bool limited = false;         ///< RefineRequest::vertices ended the refinement
  std::uint64_t rays = 0;       ///< cast for the estimates
};

/// A refined scene. save() writes its meshes, so that a bake of it fits the file.
struct RefinedScene {
  LoadedScene scene;
  RefineReport report;
};

/// Subdivides a scene's triangles by their errors (docs/notes/refinement.md). Vertices and triangles stay
/// where they are; new vertices lie on edges, and all triangles of a mesh that share an edge share its new
/// vertices. The scene is read anew from its document: changes made to `scene.scene` are lost, except its
/// moment, variant and measured materials. A bake that the document carries is left out. The same scene and
/// request give the same meshes on the same device. `device`: nullptr: opened for this call. Throws
/// UsageError for numbers out of range, and Interrupted.
RefinedScene refine(const LoadedScene& scene, const RefineRequest& request, const Device* device = nullptr,
                    Progress* progress = nullptr);

/// Writes charts into TEXCOORD_1 of each primitive whose coordinates cannot hold a map of transfer, sized for
/// maps of at most `size` texels along a side, 1..BakeRequest::maxChartSize. Vertices on chart borders are
/// duplicated. Primitives that use TEXCOORD_1 for something else stay. If anything changes, the scene is read
/// anew as by refine(). Throws UsageError for a size out of range, and Interrupted.
LoadedScene unwrap(const LoadedScene& scene, int size, Progress* progress = nullptr);

}  // namespace prelight
