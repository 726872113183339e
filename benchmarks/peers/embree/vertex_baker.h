#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::benchmarks {

struct VertexBakeRequest {
  std::uint32_t side = 8;  ///< a vertex has side x side rays
  bool transfer = false;   ///< SH transfer of order 3 with a bounce as well, not AO alone
};

/// Values at vertices, interpolated in between.
struct VertexBake {
  std::vector<float> ao;        ///< [vertex], in [0,1]
  std::vector<float> transfer;  ///< [vertex][3][9], as HarmonicTransfer; or empty
  double seconds = 0.0;         ///< with the tree
  double processorSeconds = 0.0;
};

/// A plain baker over Embree, as people write one: rays one by one from every vertex, stratified and
/// cosine-weighted around its normal. What they hit is kept, and sends on, for the bounce, what the vertices
/// around the hit received themselves. Materials have no textures for it, and backs are like fronts. Nothing
/// in a build without Embree.
std::optional<VertexBake> bakeAtVertices(const CompiledScene& scene, const VertexBakeRequest& request,
                                         std::size_t threads);

}  // namespace prelight::benchmarks
