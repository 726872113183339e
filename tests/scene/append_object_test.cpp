#include "scene/append_object.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "prelight/compiled_scene.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"

namespace prelight {
namespace {

Scene builtinSource(const char* name) {
  Warnings warnings;
  return loadScene(makeBuiltinScene(name), warnings);
}

TEST(AppendObject, SceneVertices_KeepTheirNumbersAndPlaces) {
  Warnings warnings;
  Scene scene = builtinSource("cornell");
  const CompiledScene before = compileScene(scene, warnings);
  const CompiledScene object = compileScene(builtinSource("bumps"), warnings);
  const glm::dmat4 place =
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, 0.2, 0.3)), glm::dvec3(0.01));
  const int node = appendObject(scene, builtinSource("bumps"), "Bumps", place);
  const CompiledScene after = compileScene(scene, warnings);
  ASSERT_EQ(after.vertexCount(), before.vertexCount() + object.vertexCount());
  EXPECT_EQ(after.triangleCount(), before.triangleCount() + object.triangleCount());
  for (std::uint32_t v = 0; v < before.vertexCount(); ++v)
    EXPECT_LT(glm::distance(glm::dvec3(after.positions[v]) + after.origin,
                            glm::dvec3(before.positions[v]) + before.origin),
              1e-6);
  for (std::uint32_t v = 0; v < object.vertexCount(); ++v) {
    const glm::dvec3 expected =
        0.01 * (glm::dvec3(object.positions[v]) + object.origin) + glm::dvec3(0.1, 0.2, 0.3);
    EXPECT_LT(glm::distance(glm::dvec3(after.positions[before.vertexCount() + v]) + after.origin, expected),
              1e-6);
  }
  for (std::size_t p = before.primitives.size(); p < after.primitives.size(); ++p) {
    EXPECT_EQ(after.primitives[p].node, node);
    EXPECT_EQ(after.primitives[p].name, "Bumps");
  }
  for (const PrimitiveRange& range : before.primitives) EXPECT_NE(range.node, node);
}

TEST(AppendObject, Materials_KeepTheirImages) {
  Scene scene = builtinSource("bumps");
  const std::size_t images = scene.images.size(), materials = scene.materials.size();
  ASSERT_GT(images, 0u);
  appendObject(scene, builtinSource("bumps"), "again", glm::dmat4(1.0));
  ASSERT_EQ(scene.images.size(), 2 * images);
  ASSERT_EQ(scene.materials.size(), 2 * materials);
  for (std::size_t m = 0; m < materials; ++m) {
    const int first = scene.materials[m].normalTexture.image,
              second = scene.materials[materials + m].normalTexture.image;
    EXPECT_EQ(second, first < 0 ? -1 : first + static_cast<int>(images));
  }
}

TEST(AppendObject, LightsAndCameras_AreLeftOut) {
  Scene scene = builtinSource("cornell");
  const std::size_t cameras = scene.cameras.size(), lights = scene.lights.size();
  appendObject(scene, builtinSource("rooms"), "rooms", glm::dmat4(1.0));
  EXPECT_EQ(scene.cameras.size(), cameras);
  EXPECT_EQ(scene.lights.size(), lights);
}

}  // namespace
}  // namespace prelight
