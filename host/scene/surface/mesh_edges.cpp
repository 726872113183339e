#include "scene/surface/mesh_edges.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <tuple>

namespace prelight {

std::vector<std::uint32_t> placesOfVertices(const CompiledScene& scene) {
  std::vector<std::array<std::uint32_t, 3>> keys(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 position = scene.positions[v] + 0.0f;  // -0 becomes +0
    std::memcpy(keys[v].data(), &position, sizeof position);
  }
  std::vector<std::uint32_t> order(scene.vertexCount());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  std::vector<std::uint32_t> places(scene.vertexCount());
  for (std::size_t i = 0; i < order.size(); ++i)
    places[order[i]] = i > 0 && keys[order[i]] == keys[order[i - 1]] ? places[order[i - 1]] : order[i];
  return places;
}

std::vector<EdgeSide> edgeSidesOf(const CompiledScene& scene, std::span<const std::uint32_t> places) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = places[scene.triangles[t][corner]],
                          to = places[scene.triangles[t][(corner + 1) % 3]];
      if (from == to) continue;
      sides.push_back({std::min(from, to), std::max(from, to), t, static_cast<std::uint8_t>(corner),
                       static_cast<std::uint8_t>(from > to)});
    }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
  });
  return sides;
}

}  // namespace prelight
