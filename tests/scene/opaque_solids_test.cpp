// Triangles of solids that another surface enters hide what is behind them.
#include "scene/closed_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"

namespace prelight {
namespace {

/// A ground and a block that pierces it; the block's material is the last.
CompiledScene blockInGround(bool inward = false) {
  CompiledScene scene = test::ground(2, 1.0f);
  test::append(scene, test::box(2, {-0.3f, -0.5f, -0.3f}, {0.3f, 0.5f, 0.3f}, inward));
  return scene;
}

std::size_t marked(const CompiledScene& scene) {
  const std::vector<std::uint8_t> marks = trianglesOfEnteredSolids(scene);
  return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
}

TEST(OpaqueSolids, BlockThatAGroundReachesInto_IsOneAndTheGroundIsNot) {
  const CompiledScene scene = blockInGround();
  const std::vector<std::uint8_t> marks = trianglesOfEnteredSolids(scene);
  ASSERT_EQ(marks.size(), scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    EXPECT_EQ(marks[t], t >= scene.primitives[1].firstTriangle ? 1 : 0) << t;
}

TEST(OpaqueSolids, WhatOneSeesInto_IsNone) {
  for (const auto& change :
       {+[](CompiledMaterial& m) { m.doubleSided = true; },
        +[](CompiledMaterial& m) { m.transmission = 0.5f; },
        +[](CompiledMaterial& m) { m.translucency = 0.5f; }, +[](CompiledMaterial& m) { m.blended = true; },
        +[](CompiledMaterial& m) { m.alphaCutoff = 0.5f; }}) {
    CompiledScene scene = blockInGround();
    change(scene.materials.back());
    EXPECT_TRUE(trianglesOfEnteredSolids(scene).empty());
  }
  EXPECT_TRUE(trianglesOfEnteredSolids(blockInGround(true)).empty());  // A room, seen from inside.
  CompiledScene open = blockInGround();
  open.triangles.pop_back();
  open.triangleMaterials.pop_back();
  open.triangleFlat.pop_back();
  EXPECT_TRUE(trianglesOfEnteredSolids(open).empty());
}

TEST(OpaqueSolids, ThingsBesideOneAnother_NeedNoMarks) {
  CompiledScene scene = test::ground(3, 1.0f);  // The ground shares no vertex with the box on it.
  // Stands on the ground.
  test::append(scene, test::box(2, {-0.3f, 0.0f, -0.3f}, {0.3f, 0.5f, 0.3f}, false));
  test::append(scene, test::sphere(8, 0.2f, {0.6f, 0.3f, 0.0f}));
  EXPECT_TRUE(trianglesOfEnteredSolids(scene).empty());
  EXPECT_TRUE(trianglesOfEnteredSolids(CompiledScene()).empty());
}

TEST(OpaqueSolids, SeamsThatRoundingParts_AreClosed) {
  CompiledScene scene = test::ground(2, 1.0f);
  const std::uint32_t ground = scene.triangleCount();
  test::append(scene, test::sphere(16, 0.4f, {0.1f, 0.1f, 0.1f}));
  const std::size_t ball = scene.triangleCount() - ground;
  EXPECT_EQ(marked(scene), ball);
  for (std::uint32_t v = scene.primitives[1].firstVertex; v < scene.vertexCount(); v += 3)
    scene.positions[v].x = std::nextafter(scene.positions[v].x, 9.0f);
  EXPECT_EQ(marked(scene), ball);
}

}  // namespace
}  // namespace prelight
