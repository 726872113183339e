#include "viewer/programs/draw_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"
#include "viewer/window_scene.h"

namespace prelight::viewer {
namespace {

using namespace test;

glm::dmat4 at(const glm::dvec3& place) { return glm::translate(glm::dmat4(1.0), place); }

/// A wall, a lamp with enough samples for depths to be drawn first, and optionally an object in front of the
/// wall.
QuadScene lampScene(const Material* before) {
  QuadScene quad;
  quad.add(lambertian({0.8f, 0.5f, 0.3f}));
  Material lamp = lambertian(glm::vec3(0.0f));
  lamp.emission = glm::vec3(5.0f);
  lamp.doubleSided = true;
  quad.add(lamp, 0.1f, at({0.0, 0.9, 0.5}));
  if (before != nullptr) quad.add(*before, 0.5f, at({0.0, 0.0, 0.4}));
  quad.lookFrom({0, 0, 3}, {0, 0, 0});
  quad.compile();
  return quad;
}

TEST(DrawOrder, DepthsFirst_WhereAPixelIsDear) {
  EXPECT_TRUE(drawsDepthsFirst(Shading::GlobalIllumination, 0));
  EXPECT_TRUE(drawsDepthsFirst(Shading::Sh, emitterSamples));
  EXPECT_FALSE(drawsDepthsFirst(Shading::Sh, 1));
}

TEST(DrawOrder, HolesBeforeAWall_ShowTheWall_WhereDepthsAreDrawnFirst) {
  Material holes = lambertian(glm::vec3(0.9f));
  holes.alphaMode = AlphaMode::Mask;
  holes.baseColor.a = 0.2f;
  holes.alphaCutoff = 0.5f;
  const Picture wall = lampScene(nullptr).render(square());
  EXPECT_GT(largest(wall), 0.1);
  EXPECT_LT(largestDifference(lampScene(&holes).render(square()), wall), 1e-6 * largest(wall));
}

TEST(DrawOrder, OneSidedQuadSeenFromBehind_HidesNothing_WhereDepthsAreDrawnFirst) {
  QuadScene quad = lampScene(nullptr);
  quad.add(lambertian(glm::vec3(0.9f)), 0.5f,
           glm::rotate(at({0.0, 0.0, 0.4}), 3.14159265358979, glm::dvec3(0, 1, 0)));
  quad.compile();
  const viewer::RenderOptions unshadowed = squareByBake(Shading::Phong);
  const Picture wall = lampScene(nullptr).render(unshadowed);
  EXPECT_LT(largestDifference(quad.render(unshadowed), wall), 1e-6 * largest(wall));
}

TEST(DrawOrder, Blended_FarthestFirst) {
  const gl::EglContext context;
  QuadScene quad;
  quad.add(lambertian(glm::vec3(0.5f)));
  Material pane = lambertian(glm::vec3(0.5f));
  pane.alphaMode = AlphaMode::Blend;
  for (const double z : {0.5, 0.9, 0.2}) quad.add(pane, 0.3f, at({0.0, 0.0, z}));
  quad.compile();
  const RenderScene scene(quad.inputs());
  const glm::dvec3 eye = glm::dvec3(0, 0, 3) - quad.compiled.origin;
  const DrawOrder order = drawOrderOf(scene, eye, false, {});
  EXPECT_EQ(order.opaque.size(), 1u);
  ASSERT_EQ(order.blended.size(), 3u);
  EXPECT_TRUE(std::is_sorted(order.blended.begin(), order.blended.end(),
                             [](const Batch* a, const Batch* b) { return a->center.z < b->center.z; }));
}

TEST(DrawOrder, BodyOfGlass_IsOpaque_ButWhereItCoversInPart) {
  const gl::EglContext context;
  Material glass = lambertian(glm::vec3(0.9f));
  glass.transmission = 1.0f;
  glass.thickness = 0.1f;
  for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Blend}) {
    glass.alphaMode = mode;
    QuadScene quad;
    quad.add(glass);
    quad.compile();
    const RenderScene scene(quad.inputs());
    const DrawOrder order = drawOrderOf(scene, {0, 0, 3}, true, {});
    EXPECT_EQ(order.blended.size(), mode == AlphaMode::Blend ? 1u : 0u);
    EXPECT_EQ(order.opaque.size(), mode == AlphaMode::Blend ? 0u : 1u);
  }
}

}  // namespace
}  // namespace prelight::viewer
