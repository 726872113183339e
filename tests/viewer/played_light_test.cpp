// Windows in full shading that play an animation, compared with pictures of the scene at that moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gi/update/live_light.h"
#include "gi/update/live_scenes.h"
#include "scene/pose.h"
#include "support/devices.h"
#include "viewer/follow/live_follower.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/window/scene_follower.h"

namespace prelight::viewer {
namespace {

using test::LoadedScene;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

LiveLightOptions playedOptions() {
  LiveLightOptions options;
  options.photons = 4000;
  options.texels = 400;
  options.gather.rays = 32;
  options.gather.texelsPerFrame = 0;
  options.gather.blendFrames = 4;
  options.causticPhotons = 4000;
  return options;
}

RenderOptions fullOptions() {
  RenderOptions options;
  options.shading = Shading::GlobalIllumination;
  options.width = 80;
  options.height = 80;
  options.samplesPerAxis = 1;
  return options;
}

/// The glass sphere slides to the left within 2 s, and the mirror box turns a little.
LoadedScene movingGlass() {
  LoadedScene loaded("caustics");
  Animation& animation = loaded.scene.animations.emplace_back();
  const auto sceneNode = [&](const std::string& name) {
    for (const MeshNode& node : loaded.scene.meshNodes)
      if (node.name == name) return node.sceneNode;
    return loaded.scene.nodes.size();
  };
  const auto move = [&](const std::string& name, AnimatedPath path, const glm::vec4& from,
                        const glm::vec4& to) {
    animation.channels.push_back({sceneNode(name), path, animation.samplers.size()});
    animation.samplers.push_back({Interpolation::Linear, {0, 2}, {from, to}});
  };
  const glm::vec4 ball(glm::vec3(loaded.scene.nodes[sceneNode("Glass sphere")].translation), 0.0f);
  move("Glass sphere", AnimatedPath::Translation, ball, ball - glm::vec4(0.5f, 0.0f, 0.2f, 0.0f));
  move("Mirror box", AnimatedPath::Rotation, {0, 0, 0, 1}, {0, std::sin(0.2f), 0, std::cos(0.2f)});
  return loaded;
}

/// State of a window that opens on a scene.
struct Opened {
  explicit Opened(const Scene& scene, const CompiledScene& compiled)
      : live(scene, compiled, nullptr, 0.0, playedOptions(), {}, test::sharedDevice(), quiet),
        light(illuminationOf(live)),
        inputs{.scene = scene, .compiled = compiled, .globalIllumination = &light} {}

  Progress quiet;
  LiveLight live;
  GlobalIllumination light;
  RenderInputs inputs;
};

/// Everything between a window's controls and its pictures, with its own OpenGL context.
struct Stage {
  explicit Stage(Opened& opened)
      : scene(opened.inputs),
        renderer(scene.shown()),
        light(opened.live, opened.light),
        follower(renderer, scene, {&light}),
        controls(
            makeView(opened.inputs, fullOptions()), opened.inputs.compiled, [](Shading) { return true; }, {},
            dragNodes(scene)) {
    controls.startFollowing({scene.lights(), scene.cameras()}, {true, 0});
    controls.setPlayback(Playback(opened.inputs.scene));
  }

  void show(double seconds) {
    controls.seek(seconds);
    follower.update(controls);
  }
  int settle() {
    int frames = 0;
    for (; follower.isBusy(controls.view()) && frames < 300; ++frames) follower.update(controls);
    return frames;
  }
  Picture picture() { return renderView(renderer, controls.view(), 1); }

  gl::EglContext context;
  PosedScene scene;
  Renderer renderer;
  LiveFollower light;
  SceneFollower follower;
  Controls controls;
};

/// Root mean squared difference over the mean of `b`.
double relativeRms(const Picture& a, const Picture& b) {
  double squares = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    squares += glm::dot(d, d) / 3.0;
    sum += (double(b.pixels[i].r) + b.pixels[i].g + b.pixels[i].b) / 3.0;
  }
  const auto count = static_cast<double>(a.pixels.size());
  return std::sqrt(squares / count) / (sum / count);
}

/// Picture of a window that opens at that moment.
Picture still(const Scene& scene, double seconds) {
  const Scene posed = sceneAt(scene, 0, seconds);
  Warnings warnings;
  const CompiledScene compiled = compileScene(posed, warnings);
  const Opened opened(posed, compiled);
  return renderPicture(opened.inputs, fullOptions(), warnings);
}

TEST(PlayedLight, ThatHasSettled_IsTheLightOfAStillPicture) {
  const LoadedScene loaded = movingGlass();
  constexpr double moment = 0.6;
  const Picture expected = still(loaded.scene, moment);
  Opened opened(loaded.scene, loaded.compiled);
  Stage stage(opened);
  for (const double seconds : {0.0, 1.5, 0.5}) stage.show(seconds);
  stage.show(moment);
  EXPECT_FALSE(stage.light.settled()) << "light is not late";
  EXPECT_GT(stage.settle(), 0);
  EXPECT_LT(relativeRms(stage.picture(), expected), 1e-4);
  EXPECT_THAT(stage.scene.takeNotes(), IsEmpty());
}

TEST(PlayedLight, WhileItPlays_CausticsAreOfTheLastFrames) {
  const LoadedScene loaded = movingGlass();
  Opened opened(loaded.scene, loaded.compiled);
  Stage stage(opened);
  // Light through the sphere lies on the floor below it.
  const auto meanX = [&] {
    double power = 0.0, sum = 0.0;
    for (const device::Photon& p : stage.light.caustics().photons) {
      if (p.position[1] > -0.95f || p.position[0] > 0.9f || p.position[0] < -0.9f) continue;
      power += p.power[1];
      sum += p.power[1] * p.position[0];
    }
    return sum / power;
  };
  std::vector<double> shown;
  for (int frame = 0; frame < 24; ++frame) {
    stage.show(frame / 24.0);
    shown.push_back(meanX());
  }
  // Caustics are at most eight frames behind, and four in the mean.
  stage.settle();
  const double now = meanX();
  const double aFrame = (now - shown.front()) / 24.0;
  EXPECT_LT(aFrame, 0.0);
  EXPECT_LT(std::abs(shown.back() - now), 8.0 * std::abs(aFrame));
}

TEST(PlayedLight, MaterialsThatAnAnimationChanges_StayForLightAndSaySoOnce) {
  LoadedScene loaded = movingGlass();
  Animation& animation = loaded.scene.animations[0];
  animation.properties.push_back({AnimatedProperty::BaseColor, 0, animation.samplers.size(), {1, 1, 1, 1}});
  animation.samplers.push_back({Interpolation::Linear, {0, 2}, {{1, 1, 1, 1}, {0.1f, 0.2f, 0.9f, 1}}});
  const GlobalIllumination light;
  PosedScene posed({.scene = loaded.scene, .compiled = loaded.compiled, .globalIllumination = &light});
  posed.pose({SceneMoment{0, 1.0}, {}}, Shading::GlobalIllumination);
  EXPECT_THAT(posed.takeNotes(), testing::ElementsAre(HasSubstr("materials")));
  posed.pose({SceneMoment{0, 1.5}, {}}, Shading::GlobalIllumination);
  EXPECT_THAT(posed.takeNotes(), IsEmpty());
}

TEST(PlayedLight, NodeThatIsFlattened_LeavesTheSceneAsItStoodAndSaysSo) {
  LoadedScene loaded = movingGlass();
  Animation& animation = loaded.scene.animations[0];
  animation.channels.push_back({animation.channels[0].node, AnimatedPath::Scale, animation.samplers.size()});
  animation.samplers.push_back({Interpolation::Step, {0, 1}, {{1, 1, 1, 0}, {0, 0, 0, 0}}});
  const GlobalIllumination light;
  PosedScene posed({.scene = loaded.scene, .compiled = loaded.compiled, .globalIllumination = &light});
  posed.pose({SceneMoment{0, 0.5}, {}}, Shading::GlobalIllumination);
  EXPECT_THAT(posed.takeNotes(), IsEmpty());
  const std::vector<glm::vec3> before = posed.shown().compiled.positions;
  posed.pose({SceneMoment{0, 1.5}, {}}, Shading::GlobalIllumination);
  EXPECT_EQ(posed.shown().compiled.positions, before);
  EXPECT_THAT(posed.takeNotes(), testing::ElementsAre(HasSubstr("flat")));
}

}  // namespace
}  // namespace prelight::viewer
