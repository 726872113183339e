#include "refine/coarse_triangles.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace prelight {
namespace {

TEST(CoarsePrimitives, FloorWithSomethingAboveIt_IsFound) {
  CompiledScene scene = test::ground(1, 5.0f);
  test::append(scene, test::sphere(16, 0.5f, {0.0f, 1.0f, 0.0f}));
  const std::vector<CoarsePrimitive> found = findCoarsePrimitives(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].primitive, 0u);
  EXPECT_NEAR(found[0].edge, 10.0 * std::sqrt(2.0), 1e-5);
  const auto warning = coarseWarning("level.glb", scene);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("14.1 m"), std::string::npos) << *warning;
  EXPECT_NE(warning->find("RefineRequest::error"), std::string::npos) << *warning;
}

TEST(CoarsePrimitives, FineFloor_IsNotFound) {
  CompiledScene scene = test::ground(16, 5.0f);
  test::append(scene, test::sphere(16, 0.5f, {0.0f, 1.0f, 0.0f}));
  EXPECT_TRUE(findCoarsePrimitives(scene).empty());
}

/// Nothing shadows it, however large its triangles are.
TEST(CoarsePrimitives, CubeAlone_IsNotFound) {
  const CompiledScene scene = test::box(1, glm::vec3(-1.0f), glm::vec3(1.0f), false);
  EXPECT_TRUE(findCoarsePrimitives(scene).empty());
  EXPECT_FALSE(coarseWarning("cube.glb", scene));
}

TEST(CoarsePrimitives, FloorOverSomething_IsFoundIfItHasTwoSides) {
  CompiledScene scene = test::ground(1, 5.0f);
  test::append(scene, test::sphere(16, 0.5f, {0.0f, -1.0f, 0.0f}));
  EXPECT_TRUE(findCoarsePrimitives(scene).empty());
  scene.materials[scene.triangleMaterials[0]].doubleSided = true;
  EXPECT_EQ(findCoarsePrimitives(scene).size(), 1u);
}

}  // namespace
}  // namespace prelight
