#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "techniques/slot_transfer.h"
#include "receivers/fit_mesh.h"

/// From the fit's slots to the vertices of a Bake. Every value that leaves here is finite.
namespace prelight {

inline float finiteOr(double value, float fallback) {
  const auto f = static_cast<float>(value);
  return std::isfinite(f) ? f : fallback;
}

/// Transfer of the slots of one side of surfaces: [slot][3][columns].
struct SlotValues {
  std::span<const float> rows;
  std::size_t columns = 0;
};

inline SlotValues frontValues(const SlotTransfer& transfer) { return {transfer.total, transfer.columns()}; }

/// [vertex][channel][width]: calls write(columns of the transfer, out) for every vertex and channel; out
/// takes `width` floats.
template <typename Write>
std::vector<float> packRows(const FitMesh& mesh, const SlotValues& values, const CompiledScene& scene,
                            int channels, std::size_t width, const Write& write) {
  std::vector<float> packed(scene.vertexCount() * static_cast<std::size_t>(channels) * width);
  float* out = packed.data();
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c, out += width)
      write(&values.rows[(mesh.slotOfVertex[v] * 3 + c) * values.columns], out);
  return packed;
}

}  // namespace prelight
