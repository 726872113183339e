#include "scene/light_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "prelight/compiled_scene.h"

namespace prelight {
namespace {

using std::numbers::pi;

Light areaLight(LightShape shape) {
  Light light;
  light.type = LightType::Area;
  light.name = "lamp";
  light.position = {1, 2, 3};
  light.direction = {0, -1, 0};
  light.side = {0, 0, 1};
  light.intensity = {4, 5, 6};
  light.shape = std::make_shared<const LightShape>(std::move(shape));
  return light;
}

LightShape trapezium() { return {ShapeKind::Polygon, 0.0, {{-1, -1}, {3, -1}, {1, 1}, {-1, 1}}}; }

TEST(LightShape, Area_IsThatOfOneSide) {
  EXPECT_DOUBLE_EQ(shapeArea({ShapeKind::Sphere, 2.0}), 16.0 * pi);
  EXPECT_DOUBLE_EQ(shapeArea({ShapeKind::Disk, 2.0}), 4.0 * pi);
  EXPECT_DOUBLE_EQ(shapeArea(trapezium()), 6.0);
}

TEST(LightShape, PatchesOfAPolygon_HaveItsCentroidAndNormal) {
  const Light light = areaLight(trapezium());
  glm::dvec3 mean(0.0);
  for (const LightPatch& patch : patchesOf(light, 4096)) {
    EXPECT_EQ(patch.normal, light.direction);
    EXPECT_NEAR(patch.position.y, 2.0, 1e-12);
    mean += patch.position / 4096.0;
  }
  // A rectangle of area 4 about (0, 0), and a triangle of area 2 about (5/3, -1/3); across is cross(-Y, Z) =
  // -X.
  EXPECT_NEAR(mean.z, 3.0 + 10.0 / 18.0, 2e-3);
  EXPECT_NEAR(mean.x, 1.0 + 2.0 / 18.0, 2e-3);
}

TEST(LightShape, PatchesOfASphere_FaceAwayFromItsCentreAllAround) {
  const Light light = areaLight({ShapeKind::Sphere, 0.5});
  glm::dvec3 mean(0.0);
  for (const LightPatch& patch : patchesOf(light, 64)) {
    EXPECT_NEAR(glm::length(patch.position - (light.position + 0.5 * patch.normal)), 0.0, 1e-12);
    mean += patch.normal / 64.0;
  }
  EXPECT_LT(glm::length(mean), 0.02);
}

TEST(LightShape, PatchesOfADisk_AreEvenByArea) {
  int inner = 0;
  for (const LightPatch& patch : patchesOf(areaLight({ShapeKind::Disk, 2.0}), 400))
    inner += glm::length(patch.position - glm::dvec3(1, 2, 3)) < std::sqrt(2.0) ? 1 : 0;
  EXPECT_EQ(inner, 200);
}

TEST(LightShape, Surfaces_EmitTheLightOverItsAreaToItsSide) {
  for (const LightShape& shape : {LightShape{ShapeKind::Sphere, 0.5}, {ShapeKind::Disk, 0.5}, trapezium()}) {
    Scene scene;
    std::vector<Light> lights = {Light{}, areaLight(shape)};
    ASSERT_TRUE(makeSurfacesOf(lights, scene));
    EXPECT_EQ(lights.size(), 1u);
    Warnings warnings;
    const CompiledScene compiled = compileScene(scene, warnings);
    double area = 0.0;
    for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
      const glm::dvec3 normal = geometricNormal(compiled, t);
      const glm::dvec3 place = compiled.origin + glm::dvec3(compiled.positions[compiled.triangles[t].x]);
      area += 0.5 * glm::length(normal);
      if (shape.kind == ShapeKind::Sphere)
        EXPECT_GT(glm::dot(normal, place - glm::dvec3(1, 2, 3)), 0.0);
      else
        EXPECT_LT(normal.y, 0.0);
      EXPECT_EQ(compiled.materials[compiled.triangleMaterials[t]].emission, glm::vec3(4, 5, 6));
    }
    EXPECT_NEAR(area, shapeArea(shape), 1e-4 * area);
  }
}

TEST(LightShape, LightsWithoutArea_StayAsTheyAre) {
  Scene scene;
  std::vector<Light> lights = {Light{}};
  EXPECT_FALSE(makeSurfacesOf(lights, scene));
  EXPECT_EQ(lights.size(), 1u);
  EXPECT_TRUE(scene.meshes.empty());
}

}  // namespace
}  // namespace prelight
