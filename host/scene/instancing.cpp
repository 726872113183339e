#include "scene/instancing.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight {

namespace {

/// A tree of fewer triangles is about as large as an instance's record, and slower than testing the triangles
/// directly.
constexpr std::uint32_t leastShape = 32;

/// With fewer saved triangles than this, or a lower ratio of drawn to stored triangles, a single tree is as
/// good or better: docs/notes/bvh.md has the numbers.
constexpr std::uint64_t leastSaved = 2'000'000;
constexpr std::uint64_t leastRatio = 2;

}  // namespace

Instancing instanceAll(const CompiledScene& scene) {
  Instancing found;
  found.storedTriangles = scene.triangleCount();
  found.storedVertices = scene.vertexCount();
  std::vector<std::uint8_t> met(scene.shapes.size(), 0);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const CompiledShape& shape = scene.shapes[scene.instances[i].shape];
    if (shape.triangleCount < leastShape) continue;
    found.instances.push_back(i);
    if (met[scene.instances[i].shape] != 0) {
      found.storedTriangles -= shape.triangleCount;
      found.storedVertices -= shape.vertexCount;
    }
    met[scene.instances[i].shape] = 1;
  }
  found.used = !found.instances.empty();
  found.reason =
      fmt::format("{} of the scene's {} triangles are stored: {} drawings of {} meshes share theirs",
                  found.storedTriangles, scene.triangleCount(), found.instances.size(),
                  std::count(met.begin(), met.end(), 1));
  return found;
}

Instancing chooseInstancing(const CompiledScene& scene) {
  Instancing found = instanceAll(scene);
  const std::uint64_t saved = scene.triangleCount() - found.storedTriangles;
  if (found.used && saved >= leastSaved && scene.triangleCount() >= leastRatio * found.storedTriangles)
    return found;
  const std::string why =
      scene.shapes.empty() ? "no mesh is drawn twice with the same triangles"
      : !found.used
          ? "what is drawn more than once has too few triangles"
          : fmt::format("sharing meshes would save {} of {} triangles, too few to make up for slower rays",
                        saved, scene.triangleCount());
  return {false, why, {}, scene.triangleCount(), scene.vertexCount()};
}

}  // namespace prelight
