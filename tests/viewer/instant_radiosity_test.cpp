// Instant radiosity in OpenGL: a single virtual light compared with its closed form, many with shadow rays of
// the host in double precision, and aged lights with those of a scene that never moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>

#include "integrators/live_virtual_lights.h"
#include "support/devices.h"
#include "viewer/drawn_passes.h"
#include "viewer/follow/posed_scene.h"
#include "viewer/follow/virtual_light_follower.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"
#include "viewer/window/scene_follower.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

constexpr double pi = std::numbers::pi;

device::VirtualLight virtualLight(const glm::vec3& position, const glm::vec3& normal, float intensity) {
  device::VirtualLight light{};
  for (int i = 0; i < 3; ++i) {
    light.position[i] = position[i];
    light.normal[i] = light.geometric[i] = normal[i];
    light.intensity[i] = intensity;
  }
  return light;
}

viewer::RenderOptions instantOptions(int size) {
  viewer::RenderOptions options = square(Shading::Instant, size);
  options.samplesPerAxis = 1;
  return options;
}

/// Options in which only virtual lights shine: a lamp of almost no power keeps the neutral sky away.
viewer::RenderOptions indirectOptions(int size) {
  viewer::RenderOptions options = instantOptions(size);
  options.lights = {makeLight(LightType::Point, glm::vec3(1e-20f), {0.0, 0.0, 1.0})};
  options.emitters = false;
  return options;
}

TEST(InstantShading, VirtualLightAboveAFloor_IsItsClosedForm_AndNoStrongerThanNearest) {
  QuadScene quad;
  quad.add(lambertian({0.5f, 0.25f, 1.0f}), 4.0f);
  quad.lookFrom({0.0, -3.0, 1.0}, {0.0, 0.0, 0.0});
  quad.compile();
  VirtualLightSet set;
  set.lights = {virtualLight({0.6f, 0.0f, 0.8f}, {0.0f, 0.0f, -1.0f}, 3.0f)};
  viewer::RenderInputs inputs = quad.inputs();
  inputs.virtualLights = &set;
  Warnings notes;
  // The distance is 1, and both cosines are 0.8.
  const double even = 3.0 * 0.8 * 0.8 / pi;
  expectColor(pixelAt(viewer::renderPicture(inputs, indirectOptions(33), notes)),
              even * glm::dvec3(0.5, 0.25, 1.0), 1e-4);
  set.leastSquare = 4.0f;
  expectColor(pixelAt(viewer::renderPicture(inputs, indirectOptions(33), notes)),
              even / 4.0 * glm::dvec3(0.5, 0.25, 1.0), 1e-4);
}

TEST(InstantShading, VirtualLightBehindASheet_DoesNotShine_UnlessItShinesThrough) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1.0f)), 4.0f);
  quad.lookFrom({0.0, -3.0, 1.0}, {0.0, 0.0, 0.0});
  quad.compile();
  VirtualLightSet set;
  set.lights = {virtualLight({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 3.0f)};
  viewer::RenderInputs inputs = quad.inputs();
  inputs.virtualLights = &set;
  Warnings notes;
  EXPECT_LT(largest(viewer::renderPicture(inputs, indirectOptions(33), notes)), 1e-18);
  for (float& through : set.lights[0].through) through = 2.0f;
  expectColor(pixelAt(viewer::renderPicture(inputs, indirectOptions(33), notes)), glm::dvec3(2.0 / pi), 1e-4);
}

/// A room with a coloured wall and a block that can be dragged, lit by a lamp.
struct Room {
  QuadScene quad;

  Room() {
    const auto wall = [&](const glm::vec3& albedo, double angle, const glm::dvec3& axis,
                          const glm::dvec3& place, float half = 1.0f) {
      Material material = lambertian(albedo);
      material.doubleSided = true;
      quad.add(material, half, glm::rotate(glm::translate(glm::dmat4(1.0), place), angle, axis));
    };
    wall(glm::vec3(0.7f), 0.0, {1, 0, 0}, {0, 0, -1});
    wall(glm::vec3(0.7f), pi, {1, 0, 0}, {0, 0, 1});
    wall({0.7f, 0.1f, 0.1f}, 0.5 * pi, {0, 1, 0}, {-1, 0, 0});
    wall({0.1f, 0.7f, 0.1f}, -0.5 * pi, {0, 1, 0}, {1, 0, 0});
    wall(glm::vec3(0.7f), 0.5 * pi, {1, 0, 0}, {0, 1, 0});
    wall(glm::vec3(0.6f), 0.25 * pi, {0, 1, 0}, {0.1, 0.2, -0.3}, 0.4f);
    quad.scene.lights = {makeLight(LightType::Point, {4, 4, 3}, {-0.3, -0.2, 0.7})};
    quad.lookFrom({0.13, -3.2, 0.07}, {0.03, 0, 0});  // Edges run between the centres of pixels.
    for (std::size_t i = 0; i < quad.scene.meshNodes.size(); ++i) {
      quad.scene.meshNodes[i].sceneNode = i;
      quad.scene.nodes.push_back({.node = static_cast<int>(i)});
    }
    quad.compile();
  }

  static constexpr int sheet = 5;

  LiveVirtualLights lights(const InstantOptions& options) const {
    Progress progress;
    return {quad.scene, quad.compiled, nullptr, 0.0, options, sharedDevice(), progress};
  }
};

/// Distance to the nearest triangle along a unit direction, and that triangle, by Moeller and Trumbore's
/// test.
std::optional<std::pair<double, std::uint32_t>> meet(const CompiledScene& scene, const glm::dvec3& origin,
                                                     const glm::dvec3& way, double most) {
  std::optional<std::pair<double, std::uint32_t>> nearest;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::dvec3 a(scene.positions[scene.triangles[t].x]),
        e = glm::dvec3(scene.positions[scene.triangles[t].y]) - a,
        f = glm::dvec3(scene.positions[scene.triangles[t].z]) - a;
    const glm::dvec3 p = glm::cross(way, f);
    const double determinant = glm::dot(e, p);
    if (determinant == 0.0) continue;
    const double u = glm::dot(origin - a, p) / determinant;
    const glm::dvec3 q = glm::cross(origin - a, e);
    const double v = glm::dot(way, q) / determinant, along = glm::dot(f, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || along <= 1e-6 || along >= most) continue;
    most = along;
    nearest = {along, t};
  }
  return nearest;
}

/// Irradiance of all virtual lights where a ray from the eye hits.
glm::dvec3 tracedIrradiance(const CompiledScene& scene, const VirtualLightSet& set, const glm::dvec3& eye,
                            const glm::dvec3& way) {
  const auto met = meet(scene, eye, way, 1e30);
  if (!met) return glm::dvec3(0.0);
  const glm::dvec3 point = eye + met->first * way;
  glm::dvec3 normal = glm::normalize(geometricNormal(scene, met->second));
  if (glm::dot(normal, way) > 0.0) normal = -normal;
  glm::dvec3 sum(0.0);
  for (const device::VirtualLight& light : set.lights) {
    const glm::dvec3 path = glm::dvec3(light.position[0], light.position[1], light.position[2]) - point;
    const double distance = glm::length(path);
    const glm::dvec3 toLight = path / distance;
    const glm::dvec3 facing(light.geometric[0], light.geometric[1], light.geometric[2]);
    const double arriving = glm::dot(normal, toLight), leaving = -glm::dot(facing, toLight);
    if (arriving <= 0.0 || leaving <= 0.0) continue;
    if (meet(scene, point + 1e-6 * normal, toLight, distance * (1.0 - 1e-5))) continue;
    const double square = distance * distance, least = double{set.leastSquare};
    const double given = 1.0 + double{light.nearby} * std::max(1.0 - square / least, 0.0);
    const double falloff = arriving * leaving * given / std::max(square, least);
    sum += falloff * glm::dvec3(light.intensity[0], light.intensity[1], light.intensity[2]);
  }
  return sum;
}

TEST(InstantShading, VirtualLightsOfARoom_AreThoseOfShadowRays) {
  const Room room;
  const LiveVirtualLights live = room.lights({.paths = 24});
  ASSERT_GT(live.lights().lights.size(), 24u);
  viewer::RenderInputs inputs = room.quad.inputs();
  inputs.virtualLights = &live.lights();
  constexpr int size = 40;
  Warnings notes;
  const Picture picture = viewer::renderPicture(inputs, indirectOptions(size), notes);
  const viewer::CameraMatrices camera = viewer::cameraMatrices(
      viewer::chooseCamera(room.quad.scene, room.quad.compiled, std::nullopt), room.quad.compiled, 1.0);
  const glm::dmat4 sceneFromClip = glm::inverse(camera.projection * camera.view);
  double drawn = 0.0, traced = 0.0, difference = 0.0;
  int near = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec4 far =
          sceneFromClip * glm::dvec4(2.0 * (x + 0.5) / size - 1.0, 1.0 - 2.0 * (y + 0.5) / size, 1.0, 1.0);
      const glm::dvec3 way = glm::normalize(glm::dvec3(far) / far.w - camera.position);
      const auto met = meet(room.quad.compiled, camera.position, way, 1e30);
      const glm::dvec3 found(picture.pixels[static_cast<std::size_t>(y * size + x)]);
      glm::dvec3 expected(0.0);
      if (met) {
        const auto& material = room.quad.scene.materials[room.quad.compiled.triangleMaterials[met->second]];
        expected = glm::dvec3(material.baseColor) / pi *
                   tracedIrradiance(room.quad.compiled, live.lights(), camera.position, way);
      }
      const double off = glm::length(found - expected), all = glm::length(expected);
      drawn += glm::length(found);
      traced += all;
      difference += off;
      if (off <= 0.02 * all + 1e-6) ++near;
    }
  ASSERT_GT(traced, 0.0);
  EXPECT_NEAR(drawn / traced, 1.0, 0.005);
  EXPECT_LT(difference / traced, 0.02);  // Texels of the maps at the edges of shadows.
  EXPECT_GT(near, 0.9 * double{size * size});
}

Picture still(const Room& room, const VirtualLightSet& set, const viewer::View& view) {
  viewer::RenderInputs inputs = room.quad.inputs();
  inputs.virtualLights = &set;
  viewer::Renderer renderer(inputs);
  return viewer::renderView(renderer, view, 2);
}

TEST(AgeingLights, OfALampThatHasMoved_BecomeThoseOfTheStillPicture_AFewAFrame) {
  const viewer::gl::EglContext context;
  Room room;
  const InstantOptions options{.paths = 24, .renewals = 4};
  LiveVirtualLights live = room.lights(options);
  viewer::RenderInputs inputs = room.quad.inputs();
  inputs.virtualLights = &live.lights();
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  renderer.paceUpdates(true);
  viewer::View view = viewer::makeView(inputs, instantOptions(48));
  const Picture before = viewer::renderView(renderer, view, 2);
  EXPECT_EQ(before.pixels, still(room, live.lights(), view).pixels);

  view.lights.front().position += glm::vec3(0.6f, 0.1f, -0.2f);
  viewer::VirtualLightFollower follower(live);
  const std::size_t lights = live.lights().lights.size();
  int frames = 0;
  do {
    if (follower.update({view.lights, nullptr, 0.0})) follower.show(renderer);
    viewer::renderView(renderer, view, 2);
    EXPECT_LT(drawn.virtualLightViews(), 5 * lights) << frames;
  } while (++frames < 50 && !follower.settled());
  EXPECT_EQ(frames, 24 / 4);
  EXPECT_FALSE(renderer.isBehind());

  room.quad.scene.lights = room.quad.compiled.lights = view.lights;
  const LiveVirtualLights afresh = room.lights(options);
  const Picture after = viewer::renderView(renderer, view, 2), expected = still(room, afresh.lights(), view);
  EXPECT_EQ(after.pixels, expected.pixels);
  EXPECT_GT(largestDifference(after, before), 0.1 * largest(before));
}

TEST(AgeingLights, OfASceneInWhichANodeHasMoved_BecomeThoseOfTheStillPicture_TheOldestFirst) {
  const viewer::gl::EglContext context;
  const Room room;
  const InstantOptions options{.paths = 24, .renewals = 4};
  LiveVirtualLights live = room.lights(options);
  viewer::RenderInputs inputs = room.quad.inputs();
  inputs.virtualLights = &live.lights();
  viewer::PosedScene scene(inputs);
  viewer::Renderer renderer(scene.shown());
  const DrawnPasses drawn(renderer);
  renderer.paceUpdates(true);
  viewer::View view = viewer::makeView(inputs, instantOptions(48));
  const Picture before = viewer::renderView(renderer, view, 2);
  const std::size_t lights = live.lights().lights.size();

  view.nodeShifts.assign(scene.nodes().size(), glm::dvec3(0.0));
  view.nodeShifts[Room::sheet] = {-0.4, 0.1, 0.2};
  viewer::VirtualLightFollower follower(live);
  int frames = 0;
  do {
    viewer::showPose(scene, renderer, {view.moment, view.nodeShifts}, view.shading);
    if (follower.update({view.lights, &scene.shown().compiled, 0.0})) follower.show(renderer);
    viewer::renderView(renderer, view, 2);
    EXPECT_LT(drawn.virtualLightViews(), 5 * lights) << frames;
  } while (++frames < 50 && (!follower.settled() || renderer.isBehind()));
  EXPECT_LE(frames, static_cast<int>(lights) / 4 + 1);
  EXPECT_GE(frames, static_cast<int>(lights) / 4 - 6);

  const Picture after = viewer::renderView(renderer, view, 2);
  viewer::RenderInputs moved = scene.shown();
  viewer::Renderer afresh(moved);
  EXPECT_EQ(after.pixels, viewer::renderView(afresh, view, 2).pixels);
  EXPECT_GT(largestDifference(after, before), 0.1 * largest(before));

  // A scene that has been in its current state from the start has the same paths except for rounding.
  Room other;
  other.quad.scene.meshNodes[Room::sheet].transforms[0] =
      glm::translate(glm::dmat4(1.0), view.nodeShifts[Room::sheet]) *
      other.quad.scene.meshNodes[Room::sheet].transforms[0];
  other.quad.compile();
  const LiveVirtualLights expected = other.lights(options);
  EXPECT_LT(largestDifference(after, still(other, expected.lights(), view)), 1e-3 * largest(after));
}

TEST(AgeingLights, WithoutChange_CostNothing) {
  const viewer::gl::EglContext context;
  const Room room;
  LiveVirtualLights live = room.lights({.paths = 8, .renewals = 2});
  viewer::RenderInputs inputs = room.quad.inputs();
  inputs.virtualLights = &live.lights();
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  const viewer::View view = viewer::makeView(inputs, instantOptions(16));
  viewer::renderView(renderer, view, 1);
  EXPECT_GT(drawn.virtualLightViews(), 0u);
  viewer::VirtualLightFollower follower(live);
  EXPECT_FALSE(follower.update({view.lights, nullptr, 0.0}));
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.virtualLightViews(), 0u);
}

}  // namespace
}  // namespace prelight
