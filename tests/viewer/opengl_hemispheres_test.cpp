#include "viewer/hemisphere/opengl_hemispheres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "oracle/hemisphere_view.h"
#include "receivers/surface_sampler.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Places in the middles of every `step`-th triangle.
std::vector<HemispherePlace> middles(const CompiledScene& scene, std::size_t step) {
  std::vector<HemispherePlace> places;
  for (std::uint32_t t = 0; t < scene.triangleCount(); t += static_cast<std::uint32_t>(step)) {
    const device::Receiver r = receiverAt(scene, {t, 1.0f / 3.0f, 1.0f / 3.0f, 1.0f}, Side::Front);
    places.push_back({{r.position[0], r.position[1], r.position[2]},
                      t,
                      {r.normal[0], r.normal[1], r.normal[2]},
                      {r.geometricNormal[0], r.geometricNormal[1], r.geometricNormal[2]}});
  }
  return places;
}

/// Root mean square difference of all numbers of views.
double rmsApart(std::span<const HemisphereView> a, std::span<const HemisphereView> b) {
  double sum = 0.0, count = 0.0;
  const auto add = [&](double difference) {
    sum += difference * difference;
    count += 1.0;
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    add(a[i].open - b[i].open);
    for (int c = 0; c < 3; ++c) add(a[i].direction[c] - b[i].direction[c]);
    for (std::size_t c = 0; c < a[i].harmonics.size(); ++c) add(a[i].harmonics[c] - b[i].harmonics[c]);
  }
  return std::sqrt(sum / count);
}

// Large and small triangles, edge-on ones and shading normals that lean, of an oracle in double precision.
TEST(OpenGlHemispheres, Views_AreThoseOfTheOracle) {
  CompiledScene scene = test::ground(1, 2.0f);
  test::append(scene, test::box(1, {-1.5f, 0.0f, -1.5f}, {-1.0f, 1.5f, 1.5f}, false));
  test::append(scene, test::sphere(6, 0.6f, {0.5f, 0.7f, 0.0f}));
  test::append(scene, test::randomSoup(40, 0.3f, 5));
  const std::vector<HemispherePlace> places = middles(scene, 3);
  viewer::OpenGlHemispheres renderer(scene);
  const std::vector<HemisphereView> drawn = renderer.look(places, 3);
  std::vector<HemisphereView> exact;
  for (const HemispherePlace& place : places) exact.push_back(reference::viewOf(scene, place, 3, 64));
  EXPECT_LT(rmsApart(drawn, exact), 0.006);
}

TEST(OpenGlHemispheres, SamePlaces_HaveTheSameViewsFromAnyThread) {
  const CompiledScene scene = test::box(2, {-1, -1, -1}, {1, 1, 1}, false);
  const std::vector<HemispherePlace> places = middles(scene, 1);
  viewer::OpenGlHemispheres renderer(scene);
  const std::vector<HemisphereView> here = renderer.look(places, 2);
  std::vector<HemisphereView> there;
  std::thread([&] { there = renderer.look(places, 2); }).join();
  EXPECT_EQ(rmsApart(here, there), 0.0);
}

Bake bakeOf(const CompiledScene& scene, const BakeRequest& request, HemisphereRenderer* renderer) {
  return test::runBake(scene, request, {}, renderer).bake;
}

TEST(OpenGlHemispheres, BakeOfABallOverAFloor_IsThatOfRays) {
  CompiledScene scene = test::ground(16, 2.0f);
  test::append(scene, test::sphere(8, 0.5f, {0.0f, 0.8f, 0.0f}));
  viewer::OpenGlHemispheres renderer(scene);
  BakeRequest request{.ao = true, .sh = {.order = 3}, .visibility = Visibility::Raster};
  const Bake drawn = bakeOf(scene, request, &renderer);
  EXPECT_EQ(drawn.info.rays, 0u);
  EXPECT_NE(drawn.info.visibility.find("OpenGL"), std::string::npos);
  request.visibility = Visibility::Rays;
  request.effort.rays = 16384;
  const Bake traced = bakeOf(scene, request, nullptr);
  double sum = 0.0;
  for (std::size_t i = 0; i < traced.sh->coefficients.size(); ++i)
    sum += std::pow(double(drawn.sh->coefficients[i]) - double(traced.sh->coefficients[i]), 2);
  EXPECT_LT(std::sqrt(sum / double(traced.sh->coefficients.size())), 0.004);
}

}  // namespace
}  // namespace prelight
