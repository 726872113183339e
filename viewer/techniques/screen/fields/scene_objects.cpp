#include "viewer/techniques/screen/fields/scene_objects.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "viewer/scene/occluding_material.h"

namespace prelight::viewer {
namespace {

/// Appends `count` of `values` from `first` on, where there are any.
template <typename T>
void appendSome(const std::vector<T>& values, std::uint32_t first, std::uint32_t count, std::vector<T>& to) {
  if (values.empty()) return;
  to.insert(to.end(), values.begin() + first, values.begin() + first + count);
}

void appendVertices(const CompiledScene& scene, const PrimitiveRange& range, CompiledScene& part) {
  const auto append = [&](auto member) {
    appendSome(scene.*member, range.firstVertex, range.vertexCount, part.*member);
  };
  append(&CompiledScene::positions);
  append(&CompiledScene::normals);
  append(&CompiledScene::texCoords);
  append(&CompiledScene::texCoords1);
  append(&CompiledScene::tangents);
  append(&CompiledScene::colors);
}

void appendTriangles(const CompiledScene& scene, const PrimitiveRange& range, std::uint32_t firstVertex,
                     CompiledScene& part) {
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    if (!occludes(scene.materials[scene.triangleMaterials[t]])) continue;
    part.triangles.push_back(scene.triangles[t] - range.firstVertex + firstVertex);
    part.triangleMaterials.push_back(scene.triangleMaterials[t]);
    appendSome(scene.triangleFlat, t, 1, part.triangleFlat);
  }
}

void setBounds(CompiledScene& part) {
  part.boundsMin = glm::vec3(std::numeric_limits<float>::max());
  part.boundsMax = -part.boundsMin;
  for (const glm::uvec3& corners : part.triangles)
    for (int k = 0; k < 3; ++k) {
      part.boundsMin = glm::min(part.boundsMin, part.positions[corners[k]]);
      part.boundsMax = glm::max(part.boundsMax, part.positions[corners[k]]);
    }
}

}  // namespace

std::vector<SceneObject> objectsOf(const CompiledScene& scene) {
  std::vector<SceneObject> objects;
  std::map<std::pair<int, int>, std::size_t> indices;  // by node and instance
  for (std::size_t p = 0; p < scene.primitives.size(); ++p) {
    const PrimitiveRange& range = scene.primitives[p];
    const auto [found, isNew] = indices.try_emplace({range.node, range.instance}, objects.size());
    if (isNew) objects.emplace_back();
    objects[found->second].primitives.push_back(p);
  }
  return objects;
}

std::vector<glm::vec3> placesOf(const CompiledScene& scene, const SceneObject& object) {
  std::vector<glm::vec3> places;
  for (const std::size_t p : object.primitives)
    appendSome(scene.positions, scene.primitives[p].firstVertex, scene.primitives[p].vertexCount, places);
  return places;
}

CompiledScene occluderOf(const CompiledScene& scene, const SceneObject& object) {
  CompiledScene part;
  part.origin = scene.origin;
  part.materials = scene.materials;
  part.images = scene.images;
  for (const std::size_t p : object.primitives) {
    PrimitiveRange range = scene.primitives[p];
    const std::uint32_t firstVertex = part.vertexCount(), firstTriangle = part.triangleCount();
    appendVertices(scene, range, part);
    appendTriangles(scene, range, firstVertex, part);
    range.firstVertex = firstVertex;
    range.firstTriangle = firstTriangle;
    range.triangleCount = part.triangleCount() - firstTriangle;
    part.primitives.push_back(range);
  }
  setBounds(part);
  return part;
}

}  // namespace prelight::viewer
