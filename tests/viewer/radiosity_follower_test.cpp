#include "viewer/follow/radiosity_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "gi/update/live_scenes.h"
#include "support/run_bake.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"

namespace prelight::viewer {
namespace {

using test::LoadedScene;

BakeRequest coarseRequest() {
  BakeRequest request;
  request.radiosity.wanted = true;
  request.radiosity.patchSize = 0.6;
  request.effort.rays = 128;
  return request;
}

/// RMS of the difference over RMS of the second.
double relativeDifference(const Picture& a, const Picture& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < b.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    difference += glm::dot(d, d);
    size += glm::dot(glm::dvec3(b.pixels[i]), glm::dvec3(b.pixels[i]));
  }
  return std::sqrt(difference / size);
}

/// A window on `rooms` in radiosity shading.
class RadiosityFollowerTest : public ::testing::Test {
 protected:
  Bake bakedHere() const { return test::runBake(loaded_.compiled, coarseRequest()).bake; }

  bool update() { return follower_.update({lights_, {}, 0.0, factors_}); }

  /// Waits until the follower has settled. Returns whether any new result came.
  bool settle() {
    bool any = update();
    while (!follower_.settled()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      any = update() || any;
    }
    return update() || any;
  }

  LoadedScene loaded_{"rooms"};
  std::vector<Light> lights_ = loaded_.scene.lights;
  LiveRadiosity live_{loaded_.compiled, coarseRequest(), {}};
  RadiosityFollower follower_{
      live_, {lights_, nullptr, 0.0}, RadiosityGroups({lights_, nullptr, 0.0}, false)};
  std::vector<glm::vec3> factors_ = std::vector<glm::vec3>(lights_.size() + 1, glm::vec3(1.0f));
};

TEST_F(RadiosityFollowerTest, LightsThatStay_CastNoRay) {
  EXPECT_FALSE(settle());
  EXPECT_EQ(live_.formFactorRays(), 0u);
}

TEST_F(RadiosityFollowerTest, DraggedLamp_IsDrawnAsABakeWithTheLampThere) {
  const Bake before = bakedHere();
  lights_[0].position += glm::dvec3(0.3, -0.5, 0.6);
  loaded_.compiled.lights = lights_;
  const Bake there = bakedHere();
  const gl::EglContext context;
  Renderer live({loaded_.scene, loaded_.compiled, &before}), baked({loaded_.scene, loaded_.compiled, &there});
  RenderOptions options;
  options.shading = Shading::Radiosity;
  options.height = 90;
  options.lights = lights_;
  const View view = makeView({loaded_.scene, loaded_.compiled}, options);
  const Picture expected = renderView(baked, view, 1);
  EXPECT_GT(relativeDifference(renderView(live, view, 1), expected), 0.05);
  ASSERT_TRUE(settle());
  follower_.show(live);
  EXPECT_LT(relativeDifference(renderView(live, view, 1), expected), 1e-4);
}

TEST_F(RadiosityFollowerTest, BrighterGroup_IsABakeOfBrighterLamps_AndSolvedOnceOnly) {
  factors_[0] = glm::vec3(2.0f);
  ASSERT_TRUE(settle());
  const std::uint64_t solves = live_.solves();
  factors_[0] = {0.5f, 0.25f, 3.0f};
  EXPECT_TRUE(update()) << "in the same frame";
  EXPECT_TRUE(follower_.settled());
  EXPECT_FALSE(update());
  EXPECT_EQ(live_.solves(), solves);
  loaded_.compiled.lights[0].intensity *= factors_[0];
  const std::vector<glm::vec3> baked = *bakedHere().irradiance;
  double difference = 0.0, size = 0.0;
  for (std::size_t v = 0; v < baked.size(); ++v) {
    const glm::dvec3 d = glm::dvec3(follower_.irradiance()[v]) - glm::dvec3(baked[v]);
    difference += glm::dot(d, d);
    size += glm::dot(glm::dvec3(baked[v]), glm::dvec3(baked[v]));
  }
  EXPECT_LT(std::sqrt(difference / size), 1e-4);
}

}  // namespace
}  // namespace prelight::viewer
