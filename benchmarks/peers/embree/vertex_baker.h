#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::benchmarks {

struct VertexBakeRequest {
  std::uint32_t side = 8;  ///< a vertex casts side x side rays
  bool transfer = false;   ///< also SH transfer of order 3 with a bounce, not only AO
};

/// Values at vertices, to be interpolated between them.
struct VertexBake {
  std::vector<float> ao;        ///< [vertex], in [0,1]
  std::vector<float> transfer;  ///< [vertex][3][9], as HarmonicTransfer; or empty
  double seconds = 0.0;         ///< including the build of the tree
  double processorSeconds = 0.0;
};

/// Bakes as a simple baker over Embree would: single rays from every vertex, stratified and cosine-weighted
/// around its normal. For the bounce, each hit reflects the light that the vertices around it received.
/// Textures of materials are ignored, and backs are like fronts. Returns nothing in a build without Embree.
std::optional<VertexBake> bakeAtVertices(const CompiledScene& scene, const VertexBakeRequest& request,
                                         std::size_t threads);

}  // namespace prelight::benchmarks
