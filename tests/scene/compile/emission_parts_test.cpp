#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/compile/compile_parts.h"
#include "scene/light_sources.h"
#include "support/screen_scene.h"

// Parts of emissive triangles with uneven textures.
namespace prelight {
namespace {

using test::screenScene;

double areaOf(const std::vector<Emitter>& emitters) {
  double area = 0.0;
  for (const Emitter& emitter : emitters) area += emitter.area;
  return area;
}

double powerOf(const std::vector<Emitter>& emitters) {
  double power = 0.0;
  for (const Emitter& emitter : emitters) power += emitter.area * double(emitter.radiance.x);
  return power;
}

/// The part at a point of a triangle, found as kernels find it.
std::uint32_t partAt(const EmissionParts& parts, std::uint32_t triangle, double u, double v) {
  std::uint32_t at = parts.roots[triangle];
  while ((at & EmissionParts::leaf) == 0) {
    const std::size_t part = 1.0 - u - v >= 0.5 ? 0 : u >= 0.5 ? 1 : v >= 0.5 ? 2 : 3;
    at = parts.nodes[at][part];
    u = part == 3 ? 1.0 - 2.0 * u : 2.0 * u - (part == 1 ? 1.0 : 0.0);
    v = part == 3 ? 1.0 - 2.0 * v : 2.0 * v - (part == 2 ? 1.0 : 0.0);
  }
  return at == EmissionParts::dark ? at : at & ~EmissionParts::leaf;
}

TEST(EmissionParts, WithoutTextures_ThereAreNone) {
  CompiledScene scene = test::compiledOf(screenScene({}));
  EXPECT_TRUE(scene.emissionParts.roots.empty());
  EXPECT_EQ(emittersOf(scene).size(), 2u);
  EXPECT_DOUBLE_EQ(areaOf(emittersOf(scene)), 2.0 * 1.0);
}

TEST(EmissionParts, OfAScreenLitInItsLeftQuarter_LieThere) {
  const CompiledScene scene = test::compiledOf(screenScene(test::leftQuarter(64, 32)));
  const std::vector<Emitter> emitters = emittersOf(scene);
  EXPECT_GT(emitters.size(), 4u);
  EXPECT_LT(areaOf(emitters), 0.30 * 2.0);
  // Bilinear look-ups spread the outermost lit columns: by half a texel beyond the centre on one side, and
  // across the edge of the image, which repeats, on the other.
  EXPECT_NEAR(powerOf(emitters), 0.25 * 2.0 * double(test::screenRadiance),
              1e-6 * double(test::screenRadiance));
}

TEST(EmissionParts, ThatShowBlack_AreNoEmitters) {
  CompiledScene scene = test::compiledOf(test::atlasScene());
  std::size_t glowing = 0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) glowing += emits(scene, t) ? 1 : 0;
  EXPECT_EQ(glowing, 2u) << "the lamp's";
  EXPECT_EQ(emittersOf(scene).size(), 2u);
  for (const Emitter& emitter : emittersOf(scene))
    EXPECT_EQ(emitter.radiance, glm::vec3(test::screenRadiance));
}

TEST(EmissionParts, AreFoundAtTheirPoints) {
  const CompiledScene scene = test::compiledOf(screenScene(test::noiseImage(32, 32)));
  const EmissionParts& parts = scene.emissionParts;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Emitter& emitter : emittersOf(scene)) {
    double u = unit(random), v = unit(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const glm::dvec2 place = placeOn(emitter, {u, v});
    EXPECT_EQ(partAt(parts, emitter.triangle, place.x, place.y), emitter.part);
  }
}

TEST(EmissionParts, OfManyDots_AreBoundedAndKeepThePower) {
  Image dots = test::noiseImage(512, 512);
  for (std::size_t i = 0; i < dots.rgba.size(); i += 4) {
    const bool lit = i / 4 % 512 % 37 == 0 && i / 4 / 512 % 41 == 0;
    for (std::size_t c = 0; c < 3; ++c) dots.rgba[i + c] = lit ? 255 : 0;
  }
  const CompiledScene scene = test::compiledOf(screenScene(dots));
  const std::vector<Emitter> emitters = emittersOf(scene);
  EXPECT_LE(emitters.size(), 3u * 4096u + 2u);
  EXPECT_NEAR(powerOf(emitters), 2.0 * double(test::screenRadiance) * (14.0 * 13.0) / (512.0 * 512.0),
              1e-5 * double(test::screenRadiance));
  EXPECT_LT(areaOf(emitters), 0.2) << "most of the screen is dark";
}

TEST(EmissionParts, TransformsAndSecondCoordinates_Count) {
  Scene scene = screenScene(test::leftQuarter(64, 32));
  Primitive& screen = scene.meshes[0].primitives[0];
  screen.texCoords1 = screen.texCoords0;
  screen.texCoords0.assign(4, glm::vec2(0.9f));
  TextureRef& use = scene.materials[0].emissiveTexture;
  use.texCoord = 1;
  // Stretches a quarter of the image over the whole screen.
  use.transform = glm::mat3(0.25f, 0, 0, 0, 1, 0, 0, 0, 1);
  use.wrapS = WrapMode::ClampToEdge;
  const CompiledScene compiled = test::compiledOf(scene);
  EXPECT_GT(powerOf(emittersOf(compiled)), 0.95 * 2.0 * double(test::screenRadiance));
}

TEST(EmissionParts, HolesOfAMask_EmitNothing) {
  Scene scene = screenScene({});
  Image holes = test::leftQuarter(64, 32);
  for (std::size_t i = 0; i < holes.rgba.size(); i += 4) holes.rgba[i + 3] = holes.rgba[i];
  scene.images = {holes};
  Material& glowing = scene.materials[0];
  glowing.alphaMode = AlphaMode::Mask;
  glowing.baseColorTexture.image = 0;
  EXPECT_NEAR(powerOf(emittersOf(test::compiledOf(scene))), 0.5 * double(test::screenRadiance),
              0.01 * double(test::screenRadiance));
  glowing.alphaMode = AlphaMode::Blend;
  glowing.baseColor.a = 0.5f;
  glowing.baseColorTexture.image = -1;
  EXPECT_NEAR(powerOf(emittersOf(test::compiledOf(scene))), 1.0 * double(test::screenRadiance),
              1e-5 * double(test::screenRadiance));
}

TEST(EmissionParts, OfAnotherPose_AreTheSame) {
  Scene scene = screenScene(test::leftQuarter(64, 32));
  CompiledScene compiled = test::compiledOf(scene);
  const double power = powerOf(emittersOf(compiled));
  scene.meshNodes[0].transforms[0][3] += glm::dvec4(1, 2, 3, 0);
  flattenAnew(scene, compiled);
  EXPECT_NEAR(powerOf(emittersOf(compiled)), power, 1e-6 * power);
}

TEST(EmissionParts, WhereTrianglesVanish_EmitTheirMean) {
  Scene scene = screenScene(test::leftQuarter(64, 32));
  CompiledScene compiled = test::compiledOf(scene);
  // One triangle has no area.
  scene.meshes[0].primitives[0].positions[3] = scene.meshes[0].primitives[0].positions[2];
  flattenAnew(scene, compiled);
  const std::vector<Emitter> emitters = emittersOf(compiled);
  ASSERT_EQ(emitters.size(), 1u);
  EXPECT_NEAR(emitters[0].radiance.x, 0.25f * test::screenRadiance, 1e-4f * test::screenRadiance);
}

}  // namespace
}  // namespace prelight
