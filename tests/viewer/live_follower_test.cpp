#include "viewer/follow/live_follower.h"

#include <gtest/gtest.h>

#include "gi/update/live_light.h"
#include "gi/update/live_scenes.h"
#include "support/devices.h"
#include "viewer/follow/posed_scene.h"

namespace prelight::viewer {
namespace {

using test::LoadedScene;

LiveLightOptions smallOptions() {
  LiveLightOptions options;
  options.photons = 4000;
  options.texels = 400;
  options.gather.rays = 32;
  options.gather.texelsPerFrame = 0;
  options.gather.blendFrames = 4;
  options.causticPhotons = 1000;
  options.causticFrames = 1;
  return options;
}

class LiveFollowerTest : public ::testing::Test {
 protected:
  void open(const std::string& name, double thinBeyond = 0.0) {
    loaded_.emplace(name);
    Progress progress;
    LiveLightOptions options = smallOptions();
    options.thinBeyond = thinBeyond;
    live_.emplace(loaded_->scene, loaded_->compiled, nullptr, 0.0, options, std::span<const int>(),
                  test::sharedDevice(), progress);
    start_ = illuminationOf(*live_);
    follower_.emplace(*live_, start_);
    lights_ = loaded_->compiled.lights;
    posed_.emplace(
        RenderInputs{.scene = loaded_->scene, .compiled = loaded_->compiled, .globalIllumination = &start_});
  }
  bool update(double skyRotation = 0.0) {
    return follower_->update({lights_, &posed_->shown().compiled, skyRotation, {}, eye_});
  }
  void shift(const std::string& node, const glm::dvec3& by) {
    ScenePlace place;
    for (const PosedScene::Node& n : posed_->nodes())
      place.ways.push_back(n.name == node ? by : glm::dvec3(0.0));
    posed_->pose(place, Shading::GlobalIllumination);
  }
  void settle() {
    for (int frames = 0; !follower_->settled() && frames < 200; ++frames) update();
    EXPECT_TRUE(follower_->settled());
  }

  std::optional<LoadedScene> loaded_;
  std::optional<LiveLight> live_;
  GlobalIllumination start_;
  std::optional<LiveFollower> follower_;
  std::vector<Light> lights_;
  std::optional<glm::dvec3> eye_;
  std::optional<PosedScene> posed_;
};

TEST_F(LiveFollowerTest, ViewThatStays_BringsNoNewLight) {
  open("rooms");
  EXPECT_FALSE(update());
  EXPECT_FALSE(update());
  EXPECT_EQ(follower_->frame().rays(), 0u);
}

TEST_F(LiveFollowerTest, DraggedNode_BringsTheLightOfItsNewPlace) {
  open("cornell");
  update();
  const std::vector<float> before(follower_->indirect().begin(), follower_->indirect().end());
  shift("Tall box", {0.3, 0.0, 0.2});
  EXPECT_TRUE(update());
  EXPECT_GT(follower_->frame().photons.changed, 0u);
  settle();
  LightMap expected = start_.indirect;
  setIrradiance(*live_, expected);
  EXPECT_EQ(expected.values, std::vector<float>(follower_->indirect().begin(), follower_->indirect().end()));
  EXPECT_NE(before, std::vector<float>(follower_->indirect().begin(), follower_->indirect().end()));
  shift("Tall box", glm::dvec3(0.0));
  update();
  settle();
  double difference = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    difference += std::abs(follower_->indirect()[i] - before[i]);
    sum += before[i];
  }
  EXPECT_LT(difference, 1e-3 * sum);
}

TEST_F(LiveFollowerTest, DraggedLight_IsFollowed_AndAddedOnesAreLeftAlone) {
  open("rooms");
  update();
  lights_[0].position.z += 0.4;
  EXPECT_TRUE(update());
  EXPECT_GT(follower_->frame().photons.traced, 0u);
  settle();
  lights_.push_back(lights_[0]);
  EXPECT_FALSE(update());
}

TEST_F(LiveFollowerTest, EyeThatLeavesALamp_HasItsPhotonsThinned) {
  open("rooms", 1.0);
  EXPECT_EQ(live_->photons()->pathCount(), 4000u);
  eye_ = lights_[0].position + glm::dvec3(50.0, 0.0, 0.0);
  update();
  settle();
  EXPECT_EQ(live_->photons()->pathCount(), 250u);
  EXPECT_FALSE(update());
}

TEST_F(LiveFollowerTest, DraggedCaster_TakesItsCausticsAlong) {
  open("caustics");
  update();
  const Caustics before = follower_->caustics();
  const std::vector<device::Photon> photons(before.photons.begin(), before.photons.end());
  ASSERT_FALSE(photons.empty());
  shift("Glass sphere", {-0.3, 0.0, 0.0});
  EXPECT_TRUE(update());
  const Caustics after = follower_->caustics();
  const auto meanX = [](std::span<const device::Photon> all) {
    double power = 0.0, sum = 0.0;
    for (const device::Photon& p : all) {
      if (p.position[1] > -0.9f) continue;  // On the floor, below the sphere.
      power += p.power[1];
      sum += p.power[1] * p.position[0];
    }
    return sum / power;
  };
  EXPECT_NEAR(meanX(after.photons) - meanX(photons), -0.3, 0.12);
}

TEST_F(LiveFollowerTest, IndirectLight_StartsAsTheWindowsLightMap) {
  open("cornell");
  EXPECT_EQ(std::vector<float>(follower_->indirect().begin(), follower_->indirect().end()),
            start_.indirect.values);
  EXPECT_EQ(start_.indirect.layout.texels.size(), live_->layout().texels.size());
}

}  // namespace
}  // namespace prelight::viewer
