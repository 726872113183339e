#include "viewer/follow/playback.h"

#include <gtest/gtest.h>

namespace prelight::viewer {
namespace {

/// Two animations with a duration, 1 to 3 s and 0 to 4 s, and one without.
Scene animated() {
  Scene scene;
  scene.nodes.resize(1);
  for (const std::vector<float>& times : {std::vector<float>{1, 3}, {2}, {0, 4}}) {
    Animation& animation = scene.animations.emplace_back();
    animation.samplers.push_back({Interpolation::Linear, times, std::vector<glm::vec4>(times.size())});
    animation.channels.push_back({0, AnimatedPath::Translation, 0});
  }
  scene.animations[2].name = "long";
  return scene;
}

TEST(Playback, WithoutAnimations_HasNoMomentAndDoesNotPlay) {
  Playback none;
  none.toggle();
  none.advance(1.0);
  none.seek(2.0);
  EXPECT_FALSE(none.exists());
  EXPECT_FALSE(none.moment());
  EXPECT_FALSE(none.plays());
}

TEST(Playback, OfAScene_HasThoseThatLast_AndNoMomentBeforeItPlays) {
  Playback playback(animated());
  ASSERT_EQ(playback.animations().size(), 2u);
  EXPECT_EQ(playback.animations()[0].name, "animation 0");
  EXPECT_EQ(playback.animations()[1].name, "long");
  EXPECT_FALSE(playback.moment());
  playback.toggle();
  EXPECT_EQ(playback.moment(), (SceneMoment{0, 1.0}));
  playback.choose(1);
  EXPECT_EQ(playback.moment(), (SceneMoment{2, 0.0}));
}

TEST(Playback, OfAPosedScene_StartsAtItsMoment) {
  Scene scene = animated();
  scene.moment = {2, 1.5};
  EXPECT_EQ(Playback(scene).moment(), (SceneMoment{2, 1.5}));
}

TEST(Playback, SlowFrame_MovesOnByTheLongestStepAtMost) {
  Playback playback(animated());
  playback.toggle();
  playback.advance(0.05);
  EXPECT_DOUBLE_EQ(playback.seconds(), 1.05);
  playback.advance(20.0);
  EXPECT_DOUBLE_EQ(playback.seconds(), 1.05 + Playback::longestStep);
}

TEST(Playback, PastTheEnd_BeginsAnewOrStaysThere) {
  Playback playback(animated());
  playback.toggle();
  playback.seek(2.95);
  playback.advance(0.1);
  EXPECT_NEAR(playback.seconds(), 1.05, 1e-12);
  EXPECT_TRUE(playback.plays());
  playback.setLoop(false);
  playback.seek(2.95);
  playback.advance(0.1);
  EXPECT_DOUBLE_EQ(playback.seconds(), 3.0);
  EXPECT_FALSE(playback.plays());
  playback.toggle();
  EXPECT_DOUBLE_EQ(playback.seconds(), 1.0) << "played again from its start";
}

TEST(Playback, Backwards_ComesRoundToTheEnd) {
  Playback playback(animated());
  playback.toggle();
  playback.setSpeed(-2.0);
  playback.seek(1.1);
  playback.advance(0.1);
  EXPECT_NEAR(playback.seconds(), 2.9, 1e-12);
}

TEST(Playback, Step_IsAFrameAndPauses) {
  Playback playback(animated());
  playback.toggle();
  playback.step(1);
  EXPECT_DOUBLE_EQ(playback.seconds(), 1.0 + Playback::frame);
  EXPECT_FALSE(playback.plays());
  playback.step(-3);
  EXPECT_DOUBLE_EQ(playback.seconds(), 1.0) << "not before its start";
}

}  // namespace
}  // namespace prelight::viewer
