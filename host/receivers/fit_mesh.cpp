#include "receivers/fit_mesh.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "base/parallel.h"

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

std::size_t hashOf(const VertexKey& key) {
  std::uint64_t hash = 0;
  for (const std::uint32_t word : key) hash = (hash ^ word) * 0x9e3779b97f4a7c15u ^ hash >> 29;
  return hash ^ hash >> 32;
}

/// Returns for each vertex the lowest vertex with the same key, by a hash table with open addressing.
std::vector<std::uint32_t> firstOfKey(const CompiledScene& scene, std::span<const std::uint32_t> classes) {
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> table(std::bit_ceil(2 * std::size_t{scene.vertexCount()} + 1), none);
  std::vector<std::uint32_t> first(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const VertexKey key = keyOf(scene, classes, v);
    std::size_t place = hashOf(key) & (table.size() - 1);
    while (table[place] != none && keyOf(scene, classes, table[place]) != key)
      place = (place + 1) & (table.size() - 1);
    if (table[place] == none) table[place] = v;
    first[v] = table[place];
  }
  return first;
}

void weld(const CompiledScene& scene, std::span<const std::uint32_t> classes, FitMesh& mesh) {
  const std::vector<std::uint32_t> first = firstOfKey(scene, classes);
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

void listCorners(FitMesh& mesh) {
  mesh.cornerStart.assign(mesh.slotCount() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t slot : t) ++mesh.cornerStart[slot + 1];
  std::partial_sum(mesh.cornerStart.begin(), mesh.cornerStart.end(), mesh.cornerStart.begin());
  mesh.corners.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(mesh.cornerStart.begin(), mesh.cornerStart.end() - 1);
  for (std::uint32_t c = 0; c < mesh.corners.size(); ++c)
    mesh.corners[next[mesh.triangles[c / 3][c % 3]]++] = c;
}

/// Finds the neighbours of `slot`, ascending.
void neighboursOf(const FitMesh& mesh, std::uint32_t slot, std::vector<std::uint32_t>& neighbours) {
  neighbours.clear();
  for (std::uint32_t i = mesh.cornerStart[slot]; i < mesh.cornerStart[slot + 1]; ++i)
    for (const std::uint32_t other : mesh.triangles[mesh.corners[i] / 3])
      if (other != slot) neighbours.push_back(other);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
}

void connect(FitMesh& mesh) {
  constexpr std::size_t grain = 4096;
  const auto forSlots = [&](const auto& work) {
    parallelRanges(mesh.slotCount(), grain, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> neighbours;
      for (std::size_t slot = begin; slot < end; ++slot) {
        neighboursOf(mesh, static_cast<std::uint32_t>(slot), neighbours);
        work(slot, neighbours);
      }
    });
  };
  mesh.rowStart.assign(mesh.slotCount() + 1, 0);
  forSlots([&](std::size_t slot, const std::vector<std::uint32_t>& neighbours) {
    mesh.rowStart[slot + 1] = static_cast<std::uint32_t>(neighbours.size());
  });
  std::partial_sum(mesh.rowStart.begin(), mesh.rowStart.end(), mesh.rowStart.begin());
  mesh.columns.resize(mesh.rowStart.back());
  forSlots([&](std::size_t slot, const std::vector<std::uint32_t>& neighbours) {
    std::copy(neighbours.begin(), neighbours.end(), mesh.columns.begin() + mesh.rowStart[slot]);
  });
}

void findComponents(FitMesh& mesh) {
  std::vector<std::uint32_t>& parent = mesh.components;
  parent.resize(mesh.slotCount());
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
}

}  // namespace

FitMesh makeFitMesh(const CompiledScene& scene, std::span<const std::uint32_t> classes) {
  FitMesh mesh;
  weld(scene, classes, mesh);
  mesh.triangles.reserve(scene.triangleCount());
  for (const auto& t : scene.triangles)
    mesh.triangles.push_back({mesh.slotOfVertex[t.x], mesh.slotOfVertex[t.y], mesh.slotOfVertex[t.z]});
  listCorners(mesh);
  connect(mesh);
  findComponents(mesh);
  return mesh;
}

}  // namespace prelight
