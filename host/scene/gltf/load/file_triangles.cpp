#include "scene/gltf/load/file_triangles.h"

#include <utility>

#include "scene/gltf/load/load_parts.h"

namespace prelight {

FileTriangles fileTriangles(std::vector<glm::uvec3> corners, const CompiledScene& scene,
                            const PrimitiveRange& range) {
  FileTriangles result;
  result.corners = std::move(corners);
  result.compiled.assign(result.corners.size(), FileTriangles::dropped);
  result.exchanged.assign(result.corners.size(), 0);
  // The compiled scene leaves out some triangles and keeps the order of the others.
  std::uint32_t next = 0;
  for (std::size_t t = 0; t < result.corners.size() && next < range.triangleCount; ++t) {
    const glm::uvec3 got = scene.triangles[range.firstTriangle + next] - glm::uvec3(range.firstVertex);
    const glm::uvec3 file = result.corners[t];
    const bool same = got == file, mirrored = got == glm::uvec3(file.x, file.z, file.y);
    if (!same && !mirrored) continue;
    result.exchanged[t] = same ? 0 : 1;
    result.compiled[t] = range.firstTriangle + next++;
  }
  return result;
}

FileTrianglesFinder::FileTrianglesFinder(const GltfDocument& document, const CompiledScene& scene)
    : document_(document), scene_(scene) {}

FileTrianglesFinder::~FileTrianglesFinder() = default;

FileTriangles FileTrianglesFinder::of(const PrimitiveRange& range) {
  if (!context_) context_ = std::make_unique<LoadContext>(document_, ignored_);
  const JsonCursor node = context_->root.at("nodes").at(static_cast<std::size_t>(range.node));
  const std::size_t mesh = node.at("mesh").asIndex(context_->root.countOf("meshes"), "mesh");
  if (mesh_ != mesh) {
    read_ = loadMesh(*context_, mesh);
    mesh_ = mesh;
  }
  return fileTriangles(read_.primitives.at(static_cast<std::size_t>(range.primitive)).triangles, scene_,
                       range);
}

}  // namespace prelight
