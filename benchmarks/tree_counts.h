#pragma once

#include <cstdint>
#include <span>

#include "bvh/binary_bvh.h"
#include "prelight/compiled_scene.h"
#include "shared/ray_types.h"

namespace prelight::benchmarks {

/// What rays meet on their way through a tree, a ray.
struct TreeCounts {
  double nodes = 0.0;   ///< wide nodes that are opened
  double leaves = 0.0;  ///< leaves (blocks of triangles) that are tested
  double hits = 0.0;    ///< rays that hit
};

/// Counts the steps of the wide layout's traversal on the host, in order of distance. `any` stops at the
/// first hit. All that is counted depends on the tree and the rays alone: it compares trees without a clock.
TreeCounts countSteps(const BinaryBvh& bvh, const CompiledScene& scene, std::span<const device::Ray> rays,
                      bool any);

}  // namespace prelight::benchmarks
