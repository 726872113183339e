#include "prelight/hemisphere_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "basis/sh_zonal.h"
#include "library/run_bake.h"
#include "oracle/hemisphere_view.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "support/devices.h"
#include "support/resumed.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Sees what a function says.
class TestRenderer final : public HemisphereRenderer {
 public:
  using Look = std::function<HemisphereView(const HemispherePlace&, int order)>;
  explicit TestRenderer(Look look) : look_(std::move(look)) {}

  std::string description() const override { return "test renderer"; }
  std::vector<HemisphereView> look(std::span<const HemispherePlace> places, int order) override {
    std::vector<HemisphereView> views;
    for (const HemispherePlace& place : places) views.push_back(look_(place, order));
    seen += views.size();
    return views;
  }

  std::size_t seen = 0;

 private:
  Look look_;
};

HemisphereView openSky(const HemispherePlace&, int order) {
  return {1.0f, glm::vec3(0.0f), std::vector<float>(static_cast<std::size_t>(order * order), 0.0f)};
}

BakeRequest drawnRequest(int order) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = order;
  request.visibility = Visibility::Raster;
  return request;
}

test::BakeResult bakeBy(HemisphereRenderer* renderer, const CompiledScene& scene,
                        const BakeRequest& request) {
  return test::runBake(scene, request, {}, renderer);
}

double rmsApart(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
  return std::sqrt(sum / double(a.size()));
}

TEST(DrawnHemispheres, OpenSky_GivesTheTransferOfAClampedCosineWithoutARay) {
  const CompiledScene scene = test::sphere(24, 1.0f, {0, 0, 0});
  TestRenderer renderer(openSky);
  const test::BakeResult drawn = bakeBy(&renderer, scene, drawnRequest(3));
  std::vector<double> open(9);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    EXPECT_FLOAT_EQ(drawn.bake.ao[v], 1.0f);
    EXPECT_LT(glm::distance(drawn.bake.bentNormals[v], scene.normals[v]), 1e-3f);
    sh::openTransfer(glm::normalize(glm::dvec3(scene.normals[v])), 3, open);
    // Normals between vertices are no mean of those at vertices, to which values are fitted.
    for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(drawn.bake.sh->coefficients[9 * v + c], open[c], 4e-3);
  }
  EXPECT_EQ(drawn.bake.info.rays, 0u);
  EXPECT_EQ(drawn.bake.info.visibility, "test renderer");
  EXPECT_EQ(drawn.report.receivers, renderer.seen);
}

TEST(DrawnHemispheres, ViewsOfTheOracle_GiveWhatRaysGive) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::box(1, {-0.4f, 0.3f, -0.4f}, {0.4f, 0.6f, 0.4f}, false));
  TestRenderer renderer(
      [&](const HemispherePlace& place, int order) { return reference::viewOf(scene, place, order, 32); });
  BakeRequest request = drawnRequest(3);
  request.effort.rays = 32 * HemisphereRenderer::directions;
  const Bake drawn = bakeBy(&renderer, scene, request).bake;
  request.visibility = Visibility::Rays;
  const Bake traced = bakeBy(nullptr, scene, request).bake;
  EXPECT_TRUE(traced.info.visibility.empty());
  EXPECT_LT(rmsApart(drawn.ao, traced.ao), 0.01);
  EXPECT_LT(rmsApart(drawn.sh->coefficients, traced.sh->coefficients), 0.005);
  for (std::size_t v = 0; v < drawn.ao.size(); ++v)
    EXPECT_GT(glm::dot(drawn.bentNormals[v], traced.bentNormals[v]), 0.99f) << v;
}

TEST(DrawnHemispheres, NumberOfViews_IsThatOfRaysOverDirections) {
  const CompiledScene scene = test::ground(16, 1.0f);
  TestRenderer renderer(openSky);
  BakeRequest request = drawnRequest(2);
  request.effort.rays = 4 * HemisphereRenderer::directions;
  (void)bakeBy(&renderer, scene, request);
  // Plain triangles are thinned out after a few passes, and a component has at least some receivers.
  EXPECT_LE(renderer.seen, 4 * scene.vertexCount());
  EXPECT_GT(renderer.seen, scene.vertexCount() / 2);
}

TEST(DrawnHemispheres, StoppedAgainAndAgain_EndsAsIfNeverStopped) {
  const CompiledScene scene = test::ground(24, 1.0f);
  const BakeRequest request = drawnRequest(2);
  const auto bake = [&](Progress& progress) {
    TestRenderer renderer([&](const HemispherePlace& place, int order) {
      HemisphereView view = openSky(place, order);
      view.open = 0.5f + 0.5f * std::sin(7.0f * place.position.x);
      return view;
    });
    BakeReport report;
    return bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress,
                     report, nullptr, nullptr, &renderer);
  };
  Progress progress;
  const Bake whole = bake(progress), parts = test::inManyRuns(bake);
  EXPECT_EQ(parts.ao, whole.ao);
  EXPECT_EQ(parts.sh->coefficients, whole.sh->coefficients);
}

TEST(DrawnHemispheres, WhatFollowsRays_IsRefusedByName) {
  const CompiledScene scene = test::ground(2, 1.0f);
  using Change = std::function<void(BakeRequest&)>;
  for (const auto& [named, change] : std::vector<std::pair<std::string, Change>>{
           {"BakeRequest::bounces", [](BakeRequest& r) { r.bounces = 1; }},
           {"BakeRequest::specular", [](BakeRequest& r) { r.specular = true; }},
           {"BakeRequest::subsurface", [](BakeRequest& r) { r.subsurface = true; }},
           {"OcclusionLimits::farthest", [](BakeRequest& r) { r.limits.farthest = 1.0; }},
           {"BakeRequest::shadowSets",
            [](BakeRequest& r) {
              r.shadowSets = {{{"*"}, {}}};
            }},
           {"haar", [](BakeRequest& r) { r.haar.size = 4; }},
           {"horizons", [](BakeRequest& r) { r.horizons.sectors = 8; }},
           {"volume", [](BakeRequest& r) { r.volume.size = 4; }},
           {"thickness", [](BakeRequest& r) { r.thickness = true; }}}) {
    BakeRequest request = drawnRequest(2);
    change(request);
    try {
      (void)makePlan(Scene(), scene, request);
      ADD_FAILURE() << named;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("BakeRequest::visibility"), std::string::npos) << error.what();
    }
  }
}

TEST(DrawnHemispheres, WithoutARenderer_AreRefused) {
  const LoadedScene room = loadBuiltin("cornell");
  EXPECT_THROW((void)bake(room, drawnRequest(2)), UsageError);
}

TEST(DrawnHemispheres, LampWithinTheScene_HasNoShells) {
  const LoadedScene rooms = loadBuiltin("rooms");
  BakeRequest request = drawnRequest(2);
  EXPECT_FALSE(makePlan(rooms.scene, rooms.compiled, request).runs(Pass::NearLamps));
  request.visibility = Visibility::Rays;
  EXPECT_TRUE(makePlan(rooms.scene, rooms.compiled, request).runs(Pass::NearLamps));
}

TEST(DrawnHemispheres, Plan_SaysWhatIsDrawnAndWhenThatIsWorthIt) {
  const CompiledScene scene = test::ground(32, 1.0f);
  for (const PlannedPass& pass : makePlan(Scene(), scene, drawnRequest(2)).passes)
    if (pass.name == Pass::Cast.name) {
      EXPECT_NE(pass.reason.find("about 4356 views of 2048 triangles, which are 8 triangles for each ray"),
                std::string::npos)
          << pass.reason;
      EXPECT_NE(pass.reason.find("worth it only where"), std::string::npos) << pass.reason;
    }
}

}  // namespace
}  // namespace prelight
