// Shaders that hold only the features that a scene needs, compared with shaders that hold all.
#include "viewer/programs/shader_variant.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"
#include "viewer/window_scene.h"

namespace prelight::viewer {
namespace {

using namespace test;

/// Quads of several materials under lights of several kinds; one quad is emissive.
QuadScene manyMaterials(bool sky) {
  QuadScene quad = windowScene();
  Material metal = lambertian(glm::vec3(0.9f, 0.6f, 0.3f));
  metal.metallic = 1.0f;
  metal.roughness = 0.4f;
  quad.add(metal, 0.4f, glm::translate(glm::dmat4(1.0), glm::dvec3(-0.6, -0.6, 0.4)));
  Material pane = lambertian(glm::vec3(0.3f, 0.8f, 0.4f));
  pane.alphaMode = AlphaMode::Blend;
  pane.baseColor.a = 0.5f;
  quad.add(pane, 0.4f, glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, -0.5, 0.8)));
  Material lamp = lambertian(glm::vec3(0.0f));
  lamp.emission = {3, 2, 1};
  lamp.doubleSided = true;
  quad.add(lamp, 0.2f, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.9, 0.7)));
  quad.hasEnvironment = sky;
  quad.compile();
  quad.bakeOpen(4, 3, 0.7f, 0.8);
  return quad;
}

void expectSamePictures(const QuadScene& quad, Shading shading, bool draft = false) {
  const gl::EglContext context;
  const RenderInputs inputs = quad.inputs();
  Renderer renderer(inputs);
  RenderOptions options = square(shading, 65);
  View view = makeView(inputs, options);
  view.draft = draft;
  const Picture special = renderView(renderer, view, 2);
  renderer.specialiseShaders(false);
  const Picture general = renderView(renderer, view, 2);
  EXPECT_GT(largest(general), 0.1);
  EXPECT_LT(largestDifference(special, general), 1e-5 * largest(general)) << shadingName(shading);
}

TEST(ShaderVariants, OfWhatASceneNeeds_ShowTheSameAsThoseOfEverything) {
  for (const bool sky : {true, false})
    for (const Shading shading : {Shading::Phong, Shading::Ao, Shading::Sh, Shading::Screen})
      expectSamePictures(manyMaterials(sky), shading);
}

TEST(ShaderVariants, OfSurfacesThatDifferLittle_AreShared) {
  const Features plain, textured = {Feature::BaseColorTexture}, lamp = {Feature::Emission},
                        plastic = {Feature::Layer}, metal = {Feature::Gloss, Feature::NormalTexture},
                        mirror = {Feature::Gloss, Feature::Surroundings}, glass = {Feature::Glass};
  const std::vector<Features> surfaces = {plain, plastic, textured, glass, metal, lamp, mirror};
  const Features diffuse = textured | lamp, reflecting = plastic | metal;
  const std::vector<Features> expected = {diffuse, reflecting, diffuse, glass, reflecting, diffuse, mirror};
  EXPECT_EQ(sharedFeatures(surfaces), expected);
}

TEST(ShaderVariants, OfFewLamps_ShowTheSameAsThoseOfAnyNumber) {
  QuadScene quad = manyMaterials(false);
  for (const int lamps : {0, 1, 3, 4, 5}) {
    quad.scene.lights.clear();
    for (int i = 0; i < lamps; ++i)
      quad.scene.lights.push_back(makeLight(
          LightType::Point, glm::vec3(1.0f + static_cast<float>(i), 2.0f, 1.0f), {0.3 * i, 0.2 * i, 1.5}));
    expectSamePictures(quad, Shading::Phong);
    expectSamePictures(quad, Shading::Phong, true);
  }
}

TEST(ShaderVariants, OfLights_KnowFewLampsAndFewSamples) {
  const auto counts = [](std::size_t lamps, std::size_t samples) {
    std::vector<ShadedLight> lights(lamps + samples);
    for (std::size_t i = lamps; i < lights.size(); ++i) lights[i].isSample = true;
    return fewLights(lights);
  };
  EXPECT_EQ(counts(0, 0), (LightCounts{0, 0}));
  EXPECT_EQ(counts(4, 8), (LightCounts{4, 8}));
  EXPECT_EQ(counts(4, 9), (LightCounts{4, LightCounts::many}));
  EXPECT_EQ(counts(5, 1), (LightCounts{LightCounts::many, LightCounts::many}));
}

// Light of a lamp comes through the transfer, except for its reflection in metal: shaders of other surfaces
// must not add it again.
TEST(ShaderVariants, OfLightGroupsBesideMetal_ShowTheSameAsThoseOfEverything) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(0.8f)), 1.0f);
  Material metal = lambertian(glm::vec3(0.9f, 0.6f, 0.3f));
  metal.metallic = 1.0f;
  metal.roughness = 0.4f;
  quad.add(metal, 0.4f, glm::translate(glm::dmat4(1.0), glm::dvec3(-0.6, -0.6, 0.4)));
  Material lamp = lambertian(glm::vec3(0.0f));
  lamp.emission = {3, 2, 1};
  lamp.doubleSided = true;
  quad.add(lamp, 0.2f, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.9, 0.7)));
  quad.lookFrom({0, 0, 3}, {0, 0, 0});
  quad.compile();
  quad.bake.lightGroups =
      LightGroupTransfer{{{"lamp", {1, 1, 1}}}, 1, 0, std::vector<float>(quad.compiled.vertexCount(), 0.3f)};
  expectSamePictures(quad, Shading::Lights);
}

TEST(ShaderVariants, Text_NamesEveryFeatureOnce) {
  ShaderVariant variant;
  variant.features.add(Feature::Cutouts);
  const std::string text = textOf(variant);
  EXPECT_NE(text.find("const bool hasCutouts = true;"), std::string::npos);
  EXPECT_NE(text.find("const bool hasEmitterLights = false;"), std::string::npos);
  std::size_t lines = 0;
  for (const char c : text) lines += c == '\n' ? 1 : 0;
  const std::size_t rules = countNamed<Reflection>(nameOf) + countNamed<Through>(nameOf);
  EXPECT_EQ(lines, 8u + featureCount + rules);
}

TEST(RelitTransfer, LightBesideTheScene_MovedAndBack_ShowsWhatItShowedAtFirst) {
  const gl::EglContext context;
  const QuadScene quad = windowScene();
  const RenderInputs inputs = quad.inputs();
  Renderer renderer(inputs);
  View view = makeView(inputs, square(Shading::Sh, 33));
  view.lights[0].position = {4, 5, 6};  // Outside the bounds, so that it comes through the transfer.
  const Picture first = renderView(renderer, view, 1);
  View moved = view;
  moved.lights[0].position = {-6, 5, 4};
  EXPECT_GT(largestDifference(renderView(renderer, moved, 1), first), 1e-3);
  EXPECT_EQ(largestDifference(renderView(renderer, view, 1), first), 0.0);
}

}  // namespace
}  // namespace prelight::viewer
