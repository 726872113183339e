// Shadow maps: of lights that move, with coarser maps until the view stands still, and of few and many lamps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <vector>

#include "charts/make_light_map_layout.h"
#include "gi/global_illumination.h"
#include "support/scenes.h"
#include "viewer/drawn_passes.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;

Material sheet() {
  Material material = lambertian(glm::vec3(0.5f));
  material.doubleSided = true;
  return material;
}

/// A floor, a small square 0.5 m above it, and a lamp 2 m above it. A mirror behind them shows their shadows,
/// too. There is no indirect light.
struct FloorBesideMirror {
  QuadScene quad;
  GlobalIllumination globalIllumination;

  explicit FloorBesideMirror(const Material& shade = sheet()) {
    quad.add(lambertian(glm::vec3(1.0f)), 2.0f);
    quad.add(shade, 0.3f, glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, 0.2, 0.5)));
    Material metal = lambertian(glm::vec3(1.0f));
    metal.metallic = 1.0f;
    metal.roughness = 0.0f;
    quad.add(metal, 1.0f, glm::dmat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 1.5, 0.8, 1}));
    quad.scene.lights = {makeLight(LightType::Point, {5, 5, 5}, {0.0, 0.0, 2.0})};
    quad.lookFrom({0, -2.5, 2.0}, {0, 0, 0});
    quad.compile();
    LightMapLayoutRequest request;
    request.texels = 500;
    globalIllumination.indirect.layout = makeLightMapLayout(quad.scene, quad.compiled, request);
    globalIllumination.indirect.values.assign(3 * globalIllumination.indirect.layout.texelCount(), 0.0f);
  }

  viewer::RenderInputs inputs() const {
    viewer::RenderInputs inputs = quad.inputs();
    inputs.globalIllumination = &globalIllumination;
    return inputs;
  }

  viewer::View view() const {
    return viewer::makeView(inputs(), square(viewer::Shading::GlobalIllumination, 128));
  }
};

TEST(DraftShadows, OfALightThatHasMoved_BecomeThoseOfTheStillPicture) {
  const viewer::gl::EglContext context;
  const FloorBesideMirror floor;
  viewer::Renderer renderer(floor.inputs());
  const DrawnPasses drawn(renderer);
  viewer::View view = floor.view();
  viewer::renderView(renderer, view, 1);
  view.lights.front().position += glm::vec3(0.2f, 0.1f, 0.0f);
  viewer::Renderer afresh(floor.inputs());
  const DrawnPasses drawnAfresh(afresh);
  const Picture still = viewer::renderView(afresh, view, 1);
  EXPECT_EQ(drawnAfresh.shadowTexels(), 6u * 1024u * 1024u);

  view.draft = true;
  const Picture draft = viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowTexels(), 6u * 512u * 512u);
  EXPECT_NE(draft.pixels, still.pixels);

  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowTexels(), 0u);
  view.draft = false;
  EXPECT_EQ(viewer::renderView(renderer, view, 1).pixels, still.pixels);  // In the mirror, too.
  EXPECT_EQ(drawn.shadowTexels(), 6u * 1024u * 1024u);
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowTexels(), 0u);
}

TEST(DraftShadows, OfLightsOfAllKindsAndSurfacesWithHoles_AreThoseOfTheStillPictureButForTheirEdges) {
  const viewer::gl::EglContext context;
  Material cutOut = sheet();
  cutOut.alphaMode = AlphaMode::Mask;
  cutOut.alphaCutoff = 0.5f;
  cutOut.baseColor.a = 0.4f;
  std::vector<double> greens;
  for (const Material& shade : {sheet(), cutOut})
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Directional}) {
      FloorBesideMirror floor(shade);
      floor.quad.scene.lights = {makeLight(type, {5, 5, 5}, {0.2, 0.1, 2.0}, {0.1, 0.2, -1.0})};
      viewer::View view = floor.view();
      viewer::Renderer still(floor.inputs()), moving(floor.inputs());
      const DrawnPasses ofStill(still), ofMoving(moving);
      const Picture expected = viewer::renderView(still, view, 1);
      view.draft = true;
      const Picture draft = viewer::renderView(moving, view, 1);
      double difference = 0.0, green = 0.0;
      for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
        difference += std::abs(draft.pixels[i].g - expected.pixels[i].g);
        green += expected.pixels[i].g;
      }
      EXPECT_LT(ofMoving.shadowTexels(), ofStill.shadowTexels());
      EXPECT_LT(difference, 0.01 * green) << static_cast<int>(type);  // Edges are twice as wide.
      greens.push_back(green);
    }
  for (std::size_t type = 0; type < 3; ++type) EXPECT_GT(greens[type + 3], 1.02 * greens[type]);
}

TEST(DraftShadows, OfAStillLight_StayAsFineAsTheyWere) {
  const viewer::gl::EglContext context;
  const FloorBesideMirror floor;
  viewer::Renderer renderer(floor.inputs());
  const DrawnPasses drawn(renderer);
  viewer::View view = floor.view();
  const Picture still = viewer::renderView(renderer, view, 1);
  view.draft = true;
  EXPECT_EQ(viewer::renderView(renderer, view, 1).pixels, still.pixels);
  EXPECT_EQ(drawn.shadowTexels(), 0u);
  EXPECT_EQ(drawn.faces(), 0u);
}

/// Balls on all sides of a place, in one primitive, over a floor.
struct BallsAround {
  FloorBesideMirror scene;

  explicit BallsAround(bool mixed) {
    Primitive& balls = scene.quad.add(lambertian(glm::vec3(0.5f)));
    balls.positions.clear();
    balls.normals.clear();
    balls.triangles.clear();
    balls.texCoords0.clear();
    for (const glm::vec3 center : {glm::vec3(0.7, 0, 0.8), glm::vec3(-0.7, 0.1, 0.8), glm::vec3(0, 0.8, 0.9),
                                   glm::vec3(0.1, -0.7, 0.7), glm::vec3(0, 0, 0.4), glm::vec3(0, 0, 1.9)}) {
      const auto first = static_cast<std::uint32_t>(balls.positions.size());
      const CompiledScene ball = sphere(24, 0.2f, center);
      balls.positions.insert(balls.positions.end(), ball.positions.begin(), ball.positions.end());
      balls.normals.insert(balls.normals.end(), ball.normals.begin(), ball.normals.end());
      for (const glm::uvec3& triangle : ball.triangles) balls.triangles.push_back(triangle + first);
    }
    if (mixed) std::shuffle(balls.triangles.begin(), balls.triangles.end(), std::mt19937(1));
    Light spot = makeLight(LightType::Spot, {20, 20, 20}, {1.5, -1.0, 2.5});
    spot.direction = glm::normalize(glm::vec3(-1.5f, 1.0f, -1.5f));
    Light sun = makeLight(LightType::Directional, {1, 1, 1}, {0, 0, 0});
    sun.direction = glm::normalize(glm::vec3(0.3f, 0.5f, -1.0f));
    scene.quad.scene.lights = {makeLight(LightType::Point, {5, 5, 5}, {0.0, 0.0, 1.5}), spot, sun};
    scene.quad.compile();
    LightMapLayoutRequest request;
    request.texels = 500;
    LightMap& indirect = scene.globalIllumination.indirect;
    indirect.layout = makeLightMapLayout(scene.quad.scene, scene.quad.compiled, request);
    indirect.values.assign(3 * indirect.layout.texelCount(), 0.0f);
  }

  Picture render() const {
    const viewer::gl::EglContext context;
    viewer::Renderer renderer(scene.inputs());
    return viewer::renderView(renderer, scene.view(), 1);
  }
};

// Triangles that are mixed lie on all sides in every block, so that none is left out.
TEST(ShadowMaps, WhatAViewLeavesOut_CastsNoShadowInIt) {
  const Picture ordered = BallsAround(false).render(), mixed = BallsAround(true).render();
  int different = 0;
  for (std::size_t i = 0; i < ordered.pixels.size(); ++i)
    different += glm::distance(ordered.pixels[i], mixed.pixels[i]) > 1e-4f ? 1 : 0;
  EXPECT_EQ(different, 0);
}

TEST(ShadowMaps, OfFewAndOfManyLamps_AreFoundByShadersThatKnowTheirNumber) {
  const viewer::gl::EglContext context;
  FloorBesideMirror floor;
  for (const int lamps : {1, 2, 4, 5}) {
    floor.quad.scene.lights.clear();
    for (int i = 0; i < lamps; ++i)
      floor.quad.scene.lights.push_back(makeLight(i % 2 == 0 ? LightType::Point : LightType::Directional,
                                                  glm::vec3(1.0f + static_cast<float>(i), 2.0f, 1.0f),
                                                  {0.3 * i, 0.1 * i, 2.0}, {0.2 * i, 0.1, -1.0}));
    viewer::Renderer renderer(floor.inputs());
    const Picture known = viewer::renderView(renderer, floor.view(), 1);
    renderer.specialiseShaders(false);
    const Picture any = viewer::renderView(renderer, floor.view(), 1);
    EXPECT_GT(largest(any), 0.1);
    EXPECT_LT(largestDifference(known, any), 1e-5 * largest(any)) << lamps;
  }
}

}  // namespace
}  // namespace prelight
