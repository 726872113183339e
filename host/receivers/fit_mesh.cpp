#include "receivers/fit_mesh.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace prelight {

namespace {

using VertexKey = std::array<std::uint32_t, 7>;

VertexKey keyOf(const CompiledScene& scene, std::span<const std::uint32_t> classes, std::uint32_t vertex) {
  // Adding 0 turns -0 into +0.
  const glm::vec3 p = scene.positions[vertex] + 0.0f;
  const glm::vec3 n = scene.normals[vertex] + 0.0f;
  VertexKey key{};
  std::memcpy(key.data(), &p, sizeof p);
  std::memcpy(key.data() + 3, &n, sizeof n);
  key[6] = classes.empty() ? 0 : classes[vertex];
  return key;
}

void weld(const CompiledScene& scene, std::span<const std::uint32_t> classes, FitMesh& mesh) {
  std::vector<VertexKey> keys(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) keys[v] = keyOf(scene, classes, v);
  std::vector<std::uint32_t> order(scene.vertexCount());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  std::vector<std::uint32_t> first(scene.vertexCount());  // lowest vertex of the same key
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && keys[order[i]] == keys[order[i - 1]] ? first[order[i - 1]] : order[i];
  mesh.slotOfVertex.resize(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    if (first[v] == v) {
      mesh.slotOfVertex[v] = mesh.slotCount();
      mesh.vertexOfSlot.push_back(v);
      mesh.positions.push_back(scene.positions[v]);
    } else {
      mesh.slotOfVertex[v] = mesh.slotOfVertex[first[v]];
    }
  }
}

void connect(FitMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(6 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a == b) continue;
      edges.emplace_back(a, b);
      edges.emplace_back(b, a);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  mesh.rowStart.assign(mesh.slotCount() + 1, 0);
  mesh.columns.reserve(edges.size());
  for (const auto& [row, column] : edges) {
    ++mesh.rowStart[row + 1];
    mesh.columns.push_back(column);
  }
  std::partial_sum(mesh.rowStart.begin(), mesh.rowStart.end(), mesh.rowStart.begin());
}

}  // namespace

FitMesh makeFitMesh(const CompiledScene& scene, std::span<const std::uint32_t> classes) {
  FitMesh mesh;
  weld(scene, classes, mesh);
  mesh.triangles.reserve(scene.triangleCount());
  for (const auto& t : scene.triangles)
    mesh.triangles.push_back({mesh.slotOfVertex[t.x], mesh.slotOfVertex[t.y], mesh.slotOfVertex[t.z]});
  connect(mesh);
  return mesh;
}

std::vector<std::uint32_t> componentsOf(const FitMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.slotCount());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t slot) {
    while (parent[slot] != slot) slot = parent[slot] = parent[parent[slot]];
    return slot;
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 1; k < 3; ++k) {
      const std::uint32_t a = root(t[0]), b = root(t[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t slot = 0; slot < mesh.slotCount(); ++slot) parent[slot] = root(slot);
  return parent;
}

}  // namespace prelight
