#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/run_bake.h"
#include "techniques/lamp_errors.h"
#include "techniques/occlusion_cones/cone_aperture.h"

namespace prelight {
namespace {

CompiledScene shapes() {
  Warnings warnings;
  return compileScene(loadScene(makeBuiltinScene("shapes"), warnings), warnings);
}

/// Share of a cosine-weighted sky inside a cone, by midpoints of equal weight over the hemisphere.
double openByQuadrature(double cosine, double aperture) {
  constexpr int rings = 1500, sectors = 1500;
  const double across = std::sqrt(1.0 - cosine * cosine);
  int inside = 0;
  for (int i = 0; i < rings; ++i) {
    const double up = std::sqrt((i + 0.5) / rings), out = std::sqrt(1.0 - up * up);
    for (int j = 0; j < sectors; ++j)
      inside +=
          up * cosine + out * std::cos(2.0 * std::numbers::pi * (j + 0.5) / sectors) * across > aperture;
  }
  return inside / (double(rings) * sectors);
}

TEST(ConeAperture, AboutTheNormal_IsTheClosedForm) {
  for (const double open : {0.01, 0.25, 0.5, 0.81, 0.99})
    EXPECT_NEAR(coneAperture(open, 1.0), std::sqrt(1.0 - open), 1e-6) << open;
}

TEST(ConeAperture, Aslant_LetsThroughWhatIsAccessible) {
  for (const double cosine : {0.1, 0.3, 0.6, 0.9})
    for (const double open : {0.05, 0.2, 0.5}) {
      if (open > 0.5 * (1.0 + cosine)) continue;  // No cone up to a half space is that open.
      EXPECT_NEAR(openByQuadrature(cosine, coneAperture(open, cosine)), open, 5e-4) << cosine << " " << open;
    }
}

/// Where the cone touches the horizon, the closed form must continue the search.
TEST(ConeAperture, AtTheHorizon_IsContinuous) {
  for (const double cosine : {0.2, 0.5, 0.8, 0.97}) {
    const double touching = cosine * cosine * cosine;
    EXPECT_NEAR(coneAperture(touching, cosine), std::sqrt(1.0 - cosine * cosine), 1e-9) << cosine;
    EXPECT_NEAR(coneAperture(touching * (1.0 + 1e-9), cosine), std::sqrt(1.0 - cosine * cosine), 1e-6)
        << cosine;
  }
}

TEST(ConeAperture, NothingAndAll_AreAClosedConeAndAHalfSpace) {
  EXPECT_NEAR(coneAperture(0.0, 0.7), 1.0, 1e-9);
  EXPECT_NEAR(coneAperture(1.0, 1.0), 0.0, 1e-5);
  EXPECT_NEAR(coneAperture(0.9, 0.1), 0.0, 1e-5) << "more than any cone of that axis";
}

TEST(OcclusionCones, WithoutAmbientOcclusion_AreRefused) {
  BakeRequest request;
  request.cones = true;
  request.sh.order = 1;
  EXPECT_THROW(test::runBake(shapes(), request), UsageError);
}

TEST(OcclusionCones, Plan_NamesThemWhereTheyAreAskedFor) {
  const CompiledScene scene = shapes();
  BakeRequest request;
  request.ao = true;
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::OcclusionCones));
  request.cones = true;
  EXPECT_TRUE(makePlan(Scene(), scene, request).runs(Pass::OcclusionCones));
}

TEST(OcclusionCones, NotAskedFor_AreNotThere) {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = 16;
  EXPECT_TRUE(test::runBake(shapes(), request).bake.apertures.empty());
}

TEST(OcclusionCones, LampsOverShapes_AreShadowedNearerToTheTruth) {
  const CompiledScene scene = shapes();
  BakeRequest request;
  request.ao = request.cones = true;
  request.effort.rays = 256;
  const Bake bake = test::runBake(scene, request).bake;
  const double cones = test::errorOfLamps(scene, [&](std::uint32_t v, const glm::dvec3& way, double cosine) {
    return glm::dot(way, glm::dvec3(bake.bentNormals[v])) > bake.apertures[v] ? cosine : 0.0;
  });
  const double accessibility = test::errorOfLamps(
      scene, [&](std::uint32_t v, const glm::dvec3&, double cosine) { return bake.ao[v] * cosine; });
  const double open =
      test::errorOfLamps(scene, [](std::uint32_t, const glm::dvec3&, double cosine) { return cosine; });
  RecordProperty("cones", std::to_string(cones));
  RecordProperty("accessibility", std::to_string(accessibility));
  RecordProperty("open", std::to_string(open));
  EXPECT_LT(cones, 0.9 * open);
  EXPECT_LT(cones, accessibility);
}

}  // namespace
}  // namespace prelight
