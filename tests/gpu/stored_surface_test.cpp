#include "gpu/device_scene.h"

#include <gtest/gtest.h>

#include "base/spans.h"
#include "scene/instancing.h"
#include "support/instanced_scene.h"

namespace prelight {
namespace {

/// Look-up as in the kernels: the last range that begins at the triangle or before it.
device::SurfaceRange rangeOf(const StoredSurface& stored, std::uint32_t triangle) {
  device::SurfaceRange found{};
  for (const device::SurfaceRange& range : stored.ranges())
    if (range.firstTriangle <= triangle) found = range;
  return found;
}

TEST(StoredSurface, Instances_FindTheirTrianglesAndVertices) {
  const CompiledScene scene = test::compiled(test::strewnScene(21, 3.0, 2));
  const Instancing all = instanceAll(scene);
  const StoredSurface stored(scene, all.instances);
  const auto triangles = stored.triangles(scene);
  EXPECT_EQ(triangles.size(), all.storedTriangles);
  EXPECT_EQ(stored.ofVertices(spanOf(scene.positions)).size(), all.storedVertices);
  EXPECT_LT(4 * triangles.size(), scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const device::SurfaceRange range = rangeOf(stored, t);
    const std::uint32_t index = t + range.triangleShift;
    ASSERT_LT(index, triangles.size());
    for (int corner = 0; corner < 3; ++corner)
      ASSERT_EQ(triangles[index].vertex[corner] + range.vertexShift, scene.triangles[t][corner]) << t;
    ASSERT_EQ(triangles[index].material, scene.triangleMaterials[t]);
  }
}

TEST(StoredSurface, NoInstances_StoresTheScene) {
  const CompiledScene scene = test::compiled(test::strewnScene(5, 3.0, 2));
  const StoredSurface stored(scene, {});
  ASSERT_EQ(stored.ranges().size(), 1u);
  EXPECT_EQ(stored.ranges()[0].triangleShift, 0u);
  EXPECT_EQ(stored.ranges()[0].vertexShift, 0u);
  EXPECT_EQ(stored.triangles(scene).size(), scene.triangleCount());
  EXPECT_EQ(stored.ofVertices(spanOf(scene.normals)), scene.normals);
}

}  // namespace
}  // namespace prelight
