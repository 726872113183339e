#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "relight/object_light.h"
#include "support/scenes.h"

namespace prelight::test {

/// A floor, and an object appended behind it.
struct ObjectOverFloor {
  CompiledScene scene = ground(24, 2.0f);
  VertexRange floor{0, scene.vertexCount(), 0, scene.triangleCount()};
  VertexRange object;

  explicit ObjectOverFloor(const CompiledScene& put) {
    object = {scene.vertexCount(), put.vertexCount(), scene.triangleCount(), put.triangleCount()};
    append(scene, put);
  }

  SceneParts parts() const { return {floor.triangleCount, scene.triangleCount()}; }

  void place(const glm::dmat4& transform, const CompiledScene& rest) {
    for (std::uint32_t v = 0; v < object.vertexCount; ++v)
      scene.positions[object.firstVertex + v] = glm::vec3(transform * glm::dvec4(rest.positions[v], 1.0));
  }
};

/// Root mean square of the difference, relative to that of the first.
inline double rmsDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += double(a[i] - b[i]) * double(a[i] - b[i]);
    size += double(a[i]) * double(a[i]);
  }
  return std::sqrt(sum / size);
}

}  // namespace prelight::test
