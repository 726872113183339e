// Vector occluders in OpenGL compared with OpenCL, and pictures of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/occluders.h"
#include "techniques/vector_occluders/occluder_relighter.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"
#include "viewer/techniques/vector_occluders/occluder_pass.h"
#include "viewer/techniques/vector_occluders/vertex_gloss.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;

const OccluderEye eye{{2.0, 3.0, 5.0}, true};

struct Difference {
  double range = 0.0;
  double largest = 0.0;

  void add(const float* a, const float* b, int count) {
    for (int i = 0; i < count; ++i) {
      range = std::max(range, double(std::abs(a[i])));
      // NaN counts as a huge difference.
      largest = std::abs(a[i] - b[i]) <= 1e30f ? std::max(largest, double(std::abs(a[i] - b[i]))) : 1e30;
    }
  }
};

/// Expects the same results from vertex shaders and from kernels for the same records, receivers and lights.
void expectSameAsOpenCl(const MadeOccluders& made, const std::vector<device::OccluderLight>& lights,
                        const OccluderShading& shading, const OccluderEye& from) {
  const OccluderReceivers receivers{made.positions, made.normals, glm::dvec3(0.25), made.gloss};
  OccluderRelighter relighter(sharedDevice().context(), made.transfer, receivers);
  const auto kernels = relighter.relight(lights, shading, from);
  viewer::OccluderPass pass(made.transfer, receivers.origin, receivers.points());
  pass.light(lights, shading, from);
  const auto shaders = pass.read();
  ASSERT_EQ(kernels.size(), shaders.size());
  Difference diffuse, specular, reflected, highlight;
  for (std::size_t v = 0; v < kernels.size(); ++v) {
    diffuse.add(kernels[v].diffuse, shaders[v].diffuse, 3);
    specular.add(kernels[v].specular, shaders[v].specular, 3);
    reflected.add(kernels[v].reflected, shaders[v].reflected, 3);
    highlight.add(&kernels[v].highlight, &shaders[v].highlight, 1);
  }
  EXPECT_GT(diffuse.range, 0.1);
  for (const Difference& part : {diffuse, specular, reflected, highlight})
    EXPECT_LE(part.largest, 1e-4 * part.range);
}

class OccluderPass : public ::testing::Test {
 protected:
  viewer::gl::EglContext context_;
};

TEST_F(OccluderPass, EveryFormulaAndSubsetOfVectors_IsTheSameInOpenClAndOpenGl) {
  for (const OccluderFormula formula : {OccluderFormula::Soft, OccluderFormula::Thesis}) {
    for (const std::vector<OccluderVector>& optional :
         {std::vector<OccluderVector>{},
          {OccluderVector::Transmissive},
          {OccluderVector::Caustic},
          {OccluderVector::SpecularNormal, OccluderVector::SpecularColor},
          everyOptionalVector()}) {
      OccluderShading shading;
      shading.formula = formula;
      expectSameAsOpenCl(makeOccluders(333, optional, 1), makeLights(12, 2), shading, eye);
    }
  }
}

TEST_F(OccluderPass, EveryParameterAndEffect_IsTheSameInOpenClAndOpenGl) {
  OccluderShading shading = unusualShading();
  const MadeOccluders made = makeOccluders(333, everyOptionalVector(), 3);
  for (const OccluderFormula formula : {OccluderFormula::Soft, OccluderFormula::Thesis}) {
    shading.formula = formula;
    shading.mirrors = formula == OccluderFormula::Soft ? MirrorFormula::Thesis : MirrorFormula::Lobe;
    expectSameAsOpenCl(made, makeLights(12, 4), shading, eye);
    expectSameAsOpenCl(made, makeLights(12, 4), shading, {{0.0, 0.6, 0.8}, false});
  }
}

TEST_F(OccluderPass, HundredsOfLightsAndNone_AreTheSameInOpenClAndOpenGl) {
  const MadeOccluders made = makeOccluders(100, {}, 5);
  expectSameAsOpenCl(made, makeLights(300, 6), {}, eye);
  viewer::OccluderPass pass(made.transfer, glm::dvec3(0.0),
                            OccluderReceivers{made.positions, made.normals, {}, {}}.points());
  pass.light({}, {}, eye);
  for (const device::LitVertex& lit : pass.read()) EXPECT_EQ(lit.diffuse[0], 0.0f);
}

TEST_F(OccluderPass, ShadingThatChanges_IsPreparedAnew) {
  const MadeOccluders made = makeOccluders(100, everyOptionalVector(), 7);
  const auto points = OccluderReceivers{made.positions, made.normals, {}, made.gloss}.points();
  viewer::OccluderPass pass(made.transfer, glm::dvec3(0.0), points);
  const auto lights = makeLights(4, 8);
  OccluderShading bent;
  bent.effects.waves = 0.3;
  pass.light(lights, {}, eye);
  const auto before = pass.read();
  pass.light(lights, bent, eye);
  const auto between = pass.read();
  pass.light(lights, {}, eye);
  const auto after = pass.read();
  double moved = 0.0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_EQ(before[v].diffuse[0], after[v].diffuse[0]);
    moved = std::max(moved, double(std::abs(before[v].diffuse[0] - between[v].diffuse[0])));
  }
  EXPECT_GT(moved, 0.01);
}

// A baked scene with glass, a mirror, an emitter and walls.
TEST_F(OccluderPass, BakedScene_IsTheSameInOpenClAndOpenGl) {
  Warnings warnings;
  GltfDocument document = makeBuiltinScene("caustics");
  const Scene scene = loadScene(document, warnings);
  const CompiledScene compiled = compileScene(scene, warnings);
  BakeRequest request;
  request.ao = true;
  request.occluders.wanted = true;
  request.effort.rays = 32;
  Progress progress;
  BakeReport report;
  const Plan plan = makePlan(scene, compiled, request);
  const Bake bake = bakeScene(compiled, request, plan, sharedDevice(), progress, report);
  MadeOccluders made{*bake.occluders, compiled.positions, compiled.normals,
                     viewer::vertexGloss({scene, compiled, &bake}, true)};
  EXPECT_EQ(made.transfer.stored.size(), 8u);
  for (const OccluderFormula formula : {OccluderFormula::Soft, OccluderFormula::Thesis}) {
    OccluderShading shading;
    shading.formula = formula;
    shading.effects.waves = 0.2;
    expectSameAsOpenCl(made, makeLights(12, 4), shading, eye);
  }
}

/// A quad that faces a light and the eye. Its vertices see one ball on the way to the light, or nothing.
QuadScene quadWithBall(const Material& material, bool ball) {
  QuadScene quad;
  quad.add(material);
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.scene.lights = {makeLight(LightType::Point, {20, 10, 5}, {0, 0, 4})};
  quad.compile();
  OccluderTransfer transfer;
  transfer.names = {"ball"};
  transfer.stored = {OccluderVector::Position, OccluderVector::Occlusion, OccluderVector::DiffuseNormal,
                     OccluderVector::DiffuseColor};
  transfer.offsets = {0};
  for (const glm::vec3& position : quad.compiled.positions) {
    const glm::vec3 place(0.0f, 0.0f, 3.0f);
    const glm::vec3 way = place - position;
    if (ball) {
      transfer.occluders.push_back(0);
      transfer.vectors.insert(transfer.vectors.end(), {glm::vec4(place, glm::length(way)),
                                                       glm::vec4(0.3f * glm::normalize(way), 0.32f),
                                                       glm::vec4(0.0f), glm::vec4(0.0f)});
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
  }
  quad.bake.occluders = transfer;
  return quad;
}

TEST(VoShading, OpenQuad_IsLambert) {
  const QuadScene quad = quadWithBall(lambertian({0.8f, 0.5f, 0.2f}), false);
  // The four corners have the same light, so that interpolation keeps it.
  const double d2 = 16.0 + 2.0, cosine = 4.0 / std::sqrt(d2);
  const glm::dvec3 expected = glm::dvec3(0.8, 0.5, 0.2) * glm::dvec3(20, 10, 5) * cosine / d2 / pi;
  expectColor(pixelAt(quad.render(square(Shading::Vo))), expected, 1e-3);
}

TEST(VoShading, Ball_HidesLightAndHighlight) {
  Material metal;
  metal.roughness = 0.4f;
  const glm::vec3 open = pixelAt(quadWithBall(metal, false).render(square(Shading::Vo)));
  const glm::vec3 hidden = pixelAt(quadWithBall(metal, true).render(square(Shading::Vo)));
  const glm::vec3 phong = pixelAt(quadWithBall(metal, true).render(square(Shading::Phong)));
  EXPECT_GT(open.x, 0.1f);
  // Where nothing hides a light, its reflection is computed per pixel.
  expectColor(open, glm::dvec3(phong), 1e-3);
  EXPECT_LT(hidden.x, 0.05f * open.x);
}

TEST(VoShading, AllHighlights_ShineOffDielectricsToo) {
  Material plastic;
  plastic.metallic = 0.0f;
  plastic.roughness = 0.3f;
  const QuadScene quad = quadWithBall(plastic, false);
  viewer::RenderOptions options = square(Shading::Vo);
  const glm::vec3 without = pixelAt(quad.render(options));
  options.occluders.allHighlights = true;
  const glm::vec3 with = pixelAt(quad.render(options));
  EXPECT_GT(with.x, 1.02f * without.x);
}

TEST(VoShading, LightOnASurface_IsBounded) {
  QuadScene quad = quadWithBall(lambertian({0.8f, 0.8f, 0.8f}), false);
  const double radius = std::sqrt(2.0);
  for (const Shading shading : {Shading::Vo, Shading::Phong}) {
    for (const glm::dvec3 place : {glm::dvec3(-1, -1, 0), glm::dvec3(-1, -1, 1e-7), glm::dvec3(0, 0, 1e-9)}) {
      quad.scene.lights = {makeLight(LightType::Point, glm::vec3(1), place)};
      const Picture picture = quad.render(square(shading));
      EXPECT_LE(largest(picture), 0.8 / pi / (radius * radius * 1e-6) * 1.01);
      for (const glm::vec3& pixel : picture.pixels) EXPECT_TRUE(std::isfinite(pixel.x) && pixel.x >= 0.0f);
    }
  }
}

}  // namespace
}  // namespace prelight
