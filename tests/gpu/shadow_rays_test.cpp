#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "gpu/tracer.h"
#include "oracle/brute_force.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

// Shadow rays measure the share of a light that arrives through blended surfaces and thin glass.
namespace prelight {
namespace {

using device::Hit;
using device::Ray;
using test::blendedOf;

constexpr float endless = std::numeric_limits<float>::infinity();

Ray shadowRay(const glm::vec3& o, const glm::vec3& d, float tMax = endless) {
  return {{o.x, o.y, o.z}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, tMax};
}

bool arrives(const Hit& hit) {
  return hit.triangle == PRELIGHT_NO_TRIANGLE || hit.triangle == PRELIGHT_PAST_PANES;
}

glm::vec3 shareOf(const Hit& hit) { return arrives(hit) ? glm::vec3(hit.t, hit.u, hit.v) : glm::vec3(0.0f); }

/// Fresnel reflectance of a sheet: both faces with all reflections between them.
double sheetReflectance(double cosine, double ior) {
  const double sine2 = (1.0 - cosine * cosine) / (ior * ior), beyond = std::sqrt(1.0 - sine2);
  const double s = (cosine - ior * beyond) / (cosine + ior * beyond);
  const double p = (ior * cosine - beyond) / (ior * cosine + beyond);
  const double face = 0.5 * (s * s + p * p);
  return 2.0 * face / (1.0 + face);
}

/// Sheets above one another, each with its own material.
CompiledScene sheets(const std::vector<CompiledMaterial>& materials, int cells = 1) {
  CompiledScene scene;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    CompiledScene sheet = test::ground(cells, 2.0f, float(i));
    sheet.materials[0] = materials[i];
    if (i == 0)
      scene = sheet;
    else
      test::append(scene, sheet);
  }
  return scene;
}

class ShadowRays : public ::testing::TestWithParam<BvhLayout> {
 protected:
  Tracer tracerOf(const CompiledScene& scene) { return Tracer(scene, test::sharedDevice(), GetParam()); }
};

TEST_P(ShadowRays, ThroughThinGlass_TellItsTransmittance) {
  CompiledMaterial pane = test::glass(1.5f, false);
  pane.baseColor = {0.8f, 0.9f, 1.0f};
  Tracer tracer = tracerOf(sheets({pane}));
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    const glm::vec3 way(std::sin(angle), -std::cos(angle), 0.0);
    const Hit hit = tracer.traceShadows(
        std::vector<Ray>{shadowRay(-3.0f * way + glm::vec3(0.3f, 0, 0.2f), 7.0f * way)})[0];
    EXPECT_EQ(hit.triangle, PRELIGHT_PAST_PANES);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(shareOf(hit)[c], double(pane.baseColor[c]) * (1.0 - sheetReflectance(std::cos(angle), 1.5)),
                  1e-5)
          << angle;
  }
}

TEST_P(ShadowRays, PastSeveralSurfaces_MultiplyTheirShares) {
  const CompiledMaterial pane = test::glass(1.5f, false), card = blendedOf(test::lambert(0.5f), 0.4f);
  Tracer tracer = tracerOf(sheets({pane, card, pane, card}));
  const double passed = std::pow((1.0 - sheetReflectance(1.0, 1.5)) * 0.6, 2.0);
  const auto hits = tracer.traceShadows(std::vector<Ray>{
      shadowRay({0.3f, 5, 0.1f}, {0, -1, 0}), shadowRay({0.3f, -5, 0.1f}, {0, 1, 0}),
      shadowRay({0.3f, 5, 0.1f}, {0, -1, 0}, 4.5f), shadowRay({0.3f, 1.5f, 0.1f}, {0, 1, 0}, 0.4f)});
  EXPECT_NEAR(shareOf(hits[0]).x, passed, 1e-5);
  EXPECT_EQ(shareOf(hits[0]), shareOf(hits[1])) << "either way";
  EXPECT_NEAR(shareOf(hits[2]).x, passed / (1.0 - sheetReflectance(1.0, 1.5)), 1e-5)
      << "the last one is beyond";
  EXPECT_EQ(shareOf(hits[3]), glm::vec3(1.0f));
}

TEST_P(ShadowRays, OnAnEdge_CountBothSidesOnce) {
  Tracer tracer = tracerOf(sheets({blendedOf(test::lambert(0.5f), 0.5f)}, 4));
  std::vector<Ray> rays;  // Rays along sides, diagonals and corners of cells.
  for (int x = -7; x <= 7; ++x)
    for (int z = -7; z <= 7; ++z)
      rays.push_back(shadowRay({0.25f * float(x), 1, 0.25f * float(z)}, {0, -1, 0}));
  for (const Hit& hit : tracer.traceShadows(rays)) EXPECT_NEAR(shareOf(hit).y, 0.5f, 1e-6f);
}

TEST_P(ShadowRays, OpaqueOrSolidOrRough_AreBlocked) {
  CompiledMaterial rough = test::glass(1.5f, false);
  rough.roughness = 0.3f;
  const CompiledMaterial pane = test::glass(1.5f, false);
  for (const CompiledMaterial& other : {test::lambert(0.5f), test::glass(1.5f, true), rough}) {
    Tracer tracer = tracerOf(sheets({pane, other}));
    const Hit hit = tracer.traceShadows(std::vector<Ray>{shadowRay({0.3f, 5, 0.1f}, {0, -1, 0})})[0];
    EXPECT_FALSE(arrives(hit));
  }
}

TEST_P(ShadowRays, WithoutSuchSurfaces_AreAsAnyRays) {
  Tracer tracer = tracerOf(test::randomSoup(500, 0.1f, 3));
  EXPECT_FALSE(tracer.dimsShadows());
  std::mt19937 random(5);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) rays.push_back(shadowRay({0.5f, 0.5f, 0.5f}, test::randomDirection(random)));
  const auto any = tracer.traceAny(rays), shadows = tracer.traceShadows(rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    EXPECT_EQ(arrives(shadows[i]), any[i].triangle == PRELIGHT_NO_TRIANGLE);
}

/// Long triangles, for which the tree is built with spatial splits: half of them blended, some opaque.
CompiledScene needles() {
  CompiledScene scene = test::randomSoup(400, 0.9f, 11);
  scene.materials = {blendedOf(test::lambert(0.5f), 0.2f), test::lambert(0.5f)};
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) scene.triangleMaterials[t] = t % 16 == 0 ? 1 : 0;
  return scene;
}

std::vector<Ray> raysThrough(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<Ray> rays;
  glm::vec3 origin(0.5f);
  for (std::size_t i = 0; i < count; ++i) {  // Every other run of 16 leaves one point.
    if (i % 32 >= 16 || i % 32 == 0) origin = {unit(random), unit(random), unit(random)};
    rays.push_back(shadowRay(origin, test::randomDirection(random), 0.6f));
  }
  return rays;
}

TEST_P(ShadowRays, PastManyLongTriangles_CountEachOnce) {
  const CompiledScene scene = needles();
  const std::vector<Ray> rays = raysThrough(512);
  const std::vector<Hit> hits = tracerOf(scene).traceShadows(rays);
  std::size_t dimmed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    double share = 1.0;
    bool nearEdge = false;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      CompiledScene one = scene;
      one.triangles = {scene.triangles[t]};
      const glm::dvec3 o(rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]),
          d(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
      const auto hit = reference::closestHit(one, o, d, 0.7, PRELIGHT_NO_TRIANGLE);
      if (!hit) continue;
      nearEdge = nearEdge || std::min({hit->u, hit->v, 1.0 - hit->u - hit->v}) < 1e-4 ||
                 std::abs(hit->t - 0.6) < 1e-4;
      if (hit->t <= 0.6) share *= scene.triangleMaterials[t] == 1 ? 0.0 : 0.8;
    }
    if (nearEdge) continue;
    dimmed += share > 0.0 && share < 0.6;
    EXPECT_NEAR(shareOf(hits[i]).x, share, 1e-5) << i;
  }
  EXPECT_GT(dimmed, 50u);
}

TEST_P(ShadowRays, InAnotherOrder_TellTheSameBits) {
  Tracer tracer = tracerOf(needles());
  const std::vector<Ray> rays = raysThrough(700);
  std::vector<std::size_t> order(rays.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  std::vector<Ray> shuffled;
  for (const std::size_t i : order) shuffled.push_back(rays[i]);
  const auto hits = tracer.traceShadows(rays), others = tracer.traceShadows(shuffled);
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(shareOf(hits[order[k]]), shareOf(others[k]));
}

TEST_P(ShadowRays, OfWhatMoves_MeetBothTrees) {
  CompiledScene scene = sheets({test::glass(1.5f, false), blendedOf(test::lambert(0.5f), 0.4f)});
  Tracer tracer = tracerOf(scene);
  tracer.separate(scene, std::vector<std::uint32_t>{0, 1});
  const double pane = 1.0 - sheetReflectance(1.0, 1.5);
  const std::vector<Ray> rays = {shadowRay({0.3f, 5, 0.1f}, {0, -1, 0})};
  EXPECT_NEAR(shareOf(tracer.traceShadows(rays)[0]).x, 0.6 * pane, 1e-5);
  for (std::size_t v = 0; v < 4; ++v) scene.positions[v].x += 20.0f;
  tracer.follow(scene);
  EXPECT_NEAR(shareOf(tracer.traceShadows(rays)[0]).x, 0.6, 1e-5) << "the pane has gone";
}

INSTANTIATE_TEST_SUITE_P(Layouts, ShadowRays, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& layout) {
                           return layout.param == BvhLayout::Wide ? "Wide" : "Narrow";
                         });

}  // namespace
}  // namespace prelight
