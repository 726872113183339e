#include "gpu/stored_surface.h"

#include <map>

namespace prelight {

using device::DeviceTriangle;
using device::SurfaceRange;

StoredSurface::StoredSurface(const CompiledScene& scene, std::span<const std::uint32_t> instances) {
  std::map<std::uint32_t, SurfaceRange> firstOf;  // by shape: where its first instance is stored
  std::uint32_t triangle = 0, vertex = 0;         // next to process
  for (const std::uint32_t i : instances) {
    const CompiledInstance& instance = scene.instances[i];
    const CompiledShape& shape = scene.shapes[instance.shape];
    addPart({triangle, instance.firstTriangle - triangle}, {vertex, instance.firstVertex - vertex});
    triangle = instance.firstTriangle + shape.triangleCount;
    vertex = instance.firstVertex + shape.vertexCount;
    const auto found = firstOf.find(instance.shape);
    if (found == firstOf.end()) {
      const SurfaceRange stored{0, storedTriangles_, storedVertices_, 0};
      firstOf[instance.shape] = stored;
      addPart({instance.firstTriangle, shape.triangleCount}, {instance.firstVertex, shape.vertexCount});
    } else {
      ranges_.push_back({instance.firstTriangle, found->second.triangleShift - instance.firstTriangle,
                         instance.firstVertex - found->second.vertexShift, 0});
    }
  }
  addPart({triangle, scene.triangleCount() - triangle}, {vertex, scene.vertexCount() - vertex});
}

void StoredSurface::addPart(const Part& triangles, const Part& vertices) {
  if (triangles.count == 0) return;
  ranges_.push_back(
      {triangles.first, storedTriangles_ - triangles.first, vertices.first - storedVertices_, 0});
  triangles_.push_back(triangles);
  vertices_.push_back(vertices);
  storedTriangles_ += triangles.count;
  storedVertices_ += vertices.count;
}

std::vector<DeviceTriangle> StoredSurface::triangles(const CompiledScene& scene) const {
  std::vector<DeviceTriangle> stored;
  stored.reserve(storedTriangles_);
  std::uint32_t firstVertex = 0;
  for (std::size_t p = 0; p < triangles_.size(); ++p) {
    const std::uint32_t shift = vertices_[p].first - firstVertex;
    for (std::uint32_t t = triangles_[p].first; t < triangles_[p].first + triangles_[p].count; ++t) {
      const glm::uvec3 corners = scene.triangles[t] - shift;
      stored.push_back({{corners.x, corners.y, corners.z}, scene.triangleMaterials[t]});
    }
    firstVertex += vertices_[p].count;
  }
  return stored;
}

}  // namespace prelight
