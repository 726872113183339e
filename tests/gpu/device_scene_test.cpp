// The arrays of a scene in its buffers, as kernels find them through the layout.
#include "gpu/device_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/probe_program.h"

namespace prelight {
namespace {

constexpr const char* text = R"(
#define PRELIGHT_VERTEX_COLORS
#include "transport/scene_funcs.cl"
// out: of corner 2 of triangle 1 position, normal, colour; then its material's roughness, base colour and flat flag; then of
// the last light its kind and place; then a texel of the sky and the number of light groups.
__kernel void probe(__constant const SceneLayout* layout, __global const SurfaceLine* surface,
                    __global const ShadingLine* shading, __global const LightLine* lights, __global float* out) {
  const Scene s = sceneOf(layout, surface, shading, lights);
  const DeviceTriangle t = s.surface.surface.triangles[1];
  for (uint k = 0; k < 6; ++k) out[k] = s.surface.vertices[6 * t.vertex[2] + k];
  vstore3(s.surface.surface.colors[t.vertex[2]].xyz, 2, out);
  out[9] = s.surface.materials[t.material].roughness;
  out[10] = s.surface.surface.materials[t.material].albedo[1];
  out[11] = s.surface.flat[1];
  out[12] = s.lights.punctual[1].kind;
  vstore3(vload3(0, s.lights.punctual[1].position), 0, out + 13);
  out[16] = s.lights.sky[3].y;
  out[17] = layout->lights.groupCount;
}
)";

DeviceContext& context() { return test::sharedDevice().context(); }

/// Two triangles with two materials, with vertex colours and without textures.
CompiledScene twoTriangles() {
  CompiledScene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 2, 3}};
  scene.normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0.6f, 0.8f, 0}};
  scene.texCoords.assign(4, glm::vec2(0.0f));
  scene.colors = {glm::vec4(1.0f), glm::vec4(1.0f), glm::vec4(1.0f), glm::vec4(0.1f, 0.2f, 0.3f, 1.0f)};
  scene.triangles = {{0, 2, 1}, {0, 2, 3}};
  scene.triangleMaterials = {0, 1};
  scene.triangleFlat = {0, 1};
  scene.materials.resize(2);
  scene.materials[1].roughness = 0.375f;
  scene.materials[1].baseColor = {0.25f, 0.5f, 0.75f};
  scene.boundsMax = glm::vec3(1, 2, 3);
  return scene;
}

LightTables someLights(const CompiledScene& scene, const Environment& sky) {
  Light sun, lamp;
  sun.type = LightType::Directional;
  lamp.type = LightType::Point;
  sun.intensity = lamp.intensity = glm::vec3(2.0f);
  lamp.position = {4, 5, 6};
  return makeLightTables(scene, {sun, lamp}, &sky, true);
}

std::vector<float> probed(const DeviceScene& scene) {
  const Buffer<float> out(context(), 18);
  launchOnce(context(), test::probeFile(text), {}, "probe", {1, 1}, scene.layoutBuffer(), scene.surface(),
             scene.shading(), scene.lights(), out);
  return out.read();
}

class DeviceSceneTest : public testing::Test {
 protected:
  CompiledScene compiled_ = twoTriangles();
  Environment sky_{2, 2, {glm::vec3(1.0f), glm::vec3(2.0f), glm::vec3(3.0f), glm::vec3(7.0f, 8.0f, 9.0f)}};
};

TEST_F(DeviceSceneTest, Kernels_FindWhatTheHostPacked) {
  DeviceScene scene(context(), compiled_);
  scene.setShading(compiled_, {});
  scene.setLights(someLights(compiled_, sky_), 0.0);
  const std::vector<float> expected = {
      0, 2, 3, 0.6f, 0.8f, 0, 0.1f, 0.2f, 0.3f, 0.375f, 0.5f, 1, PRELIGHT_POINT_LIGHT, 4, 5, 6, 8, 3};
  EXPECT_EQ(probed(scene), expected);
}

TEST_F(DeviceSceneTest, MovedVertices_AreWhereTheyAreNow) {
  DeviceScene scene(context(), compiled_);
  scene.setPlainShading(compiled_);
  scene.setLights(someLights(compiled_, sky_), 0.0);
  compiled_.positions[3].x = -1.0f;
  scene.follow(compiled_);
  EXPECT_EQ(probed(scene)[0], -1.0f);
}

/// A copy of a device scene has its own lights and its own array positions.
TEST_F(DeviceSceneTest, LightsOfACopy_LeaveTheFirstAsItIs) {
  DeviceScene scene(context(), compiled_);
  scene.setPlainShading(compiled_);
  scene.setLights(someLights(compiled_, sky_), 0.0);
  const std::vector<float> before = probed(scene);
  DeviceScene copy = scene;
  copy.setLights(makeLightTables(compiled_, {}, &sky_, true), 1.0);
  EXPECT_EQ(copy.layout().lights.groupCount, 1u);
  EXPECT_EQ(probed(scene), before);
}

/// A bake that follows no light uploads neither shading materials nor lights.
TEST_F(DeviceSceneTest, WhatWasNotAskedFor_IsNotUploaded) {
  const DeviceScene scene(context(), compiled_);
  EXPECT_GT(scene.surface().size(), 0u);
  EXPECT_EQ(scene.shading().memory(), nullptr);
  EXPECT_EQ(scene.lights().memory(), nullptr);
  EXPECT_EQ(scene.occluders().memory(), nullptr);
}

}  // namespace
}  // namespace prelight
