#include "viewer/window/controls.h"
#include "viewer/options/light_option.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace prelight::viewer {
namespace {

using std::numbers::pi;

class ControlsTest : public testing::Test {
 protected:
  ControlsTest() {
    scene_.boundsMin = glm::vec3(-1);
    scene_.boundsMax = glm::vec3(1);
    scene_.origin = {5, 0, 0};
    view_.camera.world = glm::translate(glm::dmat4(1.0), glm::dvec3(5, 0, 4));
    Light light;
    light.position = {5, 0, 2};
    view_.lights = {light};
  }

  Controls controls() const {
    return {view_, scene_, [](Shading shading) { return shading != Shading::Sh; }};
  }

  CompiledScene scene_;
  View view_;
};

glm::dvec3 eyeOf(const Controls& controls) { return controls.view().camera.world[3]; }

TEST_F(ControlsTest, Orbit_QuarterTurn_KeepsDistanceAndTarget) {
  Controls c = controls();
  c.drag(Drag::Orbit, {0.5, 0.0});
  EXPECT_NEAR(glm::distance(eyeOf(c), {1, 0, 0}), 0.0, 1e-12);  // Dragging right moves the camera left.
  EXPECT_NEAR(glm::distance(glm::dvec3(c.view().camera.world[2]), {-1, 0, 0}), 0.0, 1e-12);
}

TEST_F(ControlsTest, Orbit_OverThePole_StopsBeforeIt) {
  Controls c = controls();
  for (int i = 0; i < 100; ++i) c.drag(Drag::Orbit, {0.0, -0.03});
  EXPECT_GT(c.view().camera.world[1].y, 0.0);
  EXPECT_GT(eyeOf(c).y, 3.0);
}

TEST_F(ControlsTest, Zoom_ManySteps_ComesNearWithoutPassing) {
  Controls c = controls();
  c.scroll(100.0, false);
  EXPECT_GT(eyeOf(c).z, 0.0);
  EXPECT_LT(eyeOf(c).z, 0.01);
}

TEST_F(ControlsTest, Probes_WhereThereAreSome_AreHiddenAndShownAgain) {
  Controls c = controls();
  c.run(Command::ToggleProbes);
  EXPECT_FALSE(c.view().hidesProbes) << "there are none";
  c.offer({false, true});
  const std::size_t before = c.changes();
  c.run(Command::ToggleProbes);
  EXPECT_TRUE(c.view().hidesProbes);
  EXPECT_GT(c.changes(), before);
  c.run(Command::ToggleProbes);
  EXPECT_FALSE(c.view().hidesProbes);
}

TEST_F(ControlsTest, DebugViews_FollowOneAnotherAndEndWithThePicture) {
  Controls c = controls();
  c.run(Command::NextDebugView);
  EXPECT_EQ(c.view().debug.shown, DebugView::None) << "none is offered";
  c.offer({false, false, {DebugView::None, DebugView::Uv, DebugView::Tree}});
  const std::size_t before = c.changes();
  for (const DebugView expected : {DebugView::Uv, DebugView::Tree, DebugView::None, DebugView::Uv}) {
    c.run(Command::NextDebugView);
    EXPECT_EQ(c.view().debug.shown, expected);
  }
  EXPECT_EQ(c.changes(), before + 4);
  DebugOptions deep = c.view().debug;
  deep.treeDepth = 1000;
  c.setDebug(deep);
  EXPECT_EQ(c.view().debug.treeDepth, DebugOptions::deepestTree);
}

TEST_F(ControlsTest, Node_Dragged_FollowsTheMouseAtItsDepth) {
  Controls c(view_, scene_, [](Shading) { return true; }, {}, {{"first", {5, 0, 0}}, {"second", {5, 0, 2}}});
  c.run(Command::NextNode);
  const std::size_t before = c.changes();
  c.drag(Drag::Node, {0.25, -0.5});
  EXPECT_GT(c.changes(), before);
  const double height = 2.0 * std::tan(0.5 * view_.camera.yFov) * 2.0;
  EXPECT_NEAR(glm::distance(c.view().nodeShifts[1], height * glm::dvec3(0.25, -0.5, 0.0)), 0.0, 1e-12);
  EXPECT_EQ(c.view().nodeShifts[0], glm::dvec3(0.0));
  c.drag(Drag::Node, {-0.25, 0.5});
  EXPECT_NEAR(glm::length(c.view().nodeShifts[1]), 0.0, 1e-12);
}

TEST_F(ControlsTest, AnimatedLightAndCamera_AreFollowed_UntilTheUserMovesTheCamera) {
  Controls c = controls();
  std::vector<Light> lights = view_.lights;
  std::vector<Camera> cameras = {view_.camera};
  c.startFollowing({lights, cameras}, {true, 0});
  c.drag(Drag::Light, {0.25, 0.0});
  const glm::dvec3 dragged = c.view().lights[0].position;
  cameras[0].world[3].x = 6.0;
  c.follow({lights, cameras});
  EXPECT_EQ(c.view().lights[0].position, dragged) << "the animation does not move it";
  EXPECT_EQ(eyeOf(c).x, 6.0);
  lights[0].position = {5, 1, 2};
  c.scroll(1.0, false);
  const glm::dvec3 eye = eyeOf(c);
  cameras[0].world[3].x = 7.0;
  c.follow({lights, cameras});
  EXPECT_EQ(c.view().lights[0].position, lights[0].position);
  EXPECT_EQ(eyeOf(c), eye);
  c.run(Command::ResetView);
  EXPECT_EQ(eyeOf(c).x, 7.0);
}

TEST_F(ControlsTest, OtherLightsThanTheScenes_AreNotFollowed) {
  Controls c = controls();
  std::vector<Light> lights = view_.lights;
  c.startFollowing({lights, {}}, {false, std::nullopt});
  lights[0].position = {5, 1, 2};
  c.follow({lights, {}});
  EXPECT_EQ(c.view().lights[0].position, view_.lights[0].position);
}

TEST_F(ControlsTest, Animation_Played_ChangesTheViewAsTimePasses) {
  Scene scene;
  scene.nodes.resize(1);
  Animation& animation = scene.animations.emplace_back();
  animation.samplers.push_back({Interpolation::Linear, {0, 2}, std::vector<glm::vec4>(2)});
  animation.channels.push_back({0, AnimatedPath::Translation, 0});
  Controls c = controls();
  c.setPlayback(Playback(scene));
  c.passTime(0.05);
  EXPECT_FALSE(c.view().moment);
  const std::size_t before = c.changes();
  c.run(Command::PlayOrPause);
  c.run(Command::Faster);
  c.passTime(0.05);
  EXPECT_EQ(c.view().moment, (SceneMoment{0, 0.1}));
  EXPECT_GT(c.changes(), before);
  c.run(Command::FrameBack);
  const std::size_t paused = c.changes();
  c.passTime(0.05);
  EXPECT_EQ(c.changes(), paused);
  c.run(Command::ToStart);
  EXPECT_EQ(c.view().moment, (SceneMoment{0, 0.0}));
}

TEST_F(ControlsTest, Node_WithoutAny_IsNotDragged) {
  Controls c = controls();
  const std::size_t before = c.changes();
  c.drag(Drag::Node, {0.25, 0.0});
  EXPECT_EQ(c.changes(), before);
}

TEST_F(ControlsTest, Pan_Right_MovesThePictureWithTheMouse) {
  Controls c = controls();
  c.drag(Drag::Pan, {0.1, 0.0});
  EXPECT_NEAR(eyeOf(c).x, 5.0 - 0.1 * 2.0 * std::tan(0.5 * view_.camera.yFov) * 4.0, 1e-12);
}

TEST_F(ControlsTest, LightDrag_Right_MovesItRightOnItsSphere) {
  Controls c = controls();
  c.drag(Drag::Light, {0.25, 0.0});
  const glm::dvec3 p = c.view().lights[0].position;
  EXPECT_GT(p.x, 6.0);
  EXPECT_NEAR(glm::distance(p, scene_.origin), 2.0, 1e-12);
  c.drag(Drag::Light, {0.0, 0.1});
  EXPECT_GT(c.view().lights[0].position.y, 0.0);
}

TEST_F(ControlsTest, LightDrag_OfAnAreaLight_TurnsItsShapeWithIt) {
  const Light quad = parseLight("area:quad:0,0,2:0,0,-1:2,1:1,1,1:turn=30");
  const glm::dvec3 place = view_.lights[0].position;
  view_.lights[0] = quad;
  view_.lights[0].position = place;
  Controls c = controls();
  c.drag(Drag::Light, {0.25, 0.1});
  const Light& light = c.view().lights[0];
  EXPECT_NEAR(glm::length(light.side), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(light.side, light.direction), 0.0, 1e-12);
  // The light keeps its angle to the scene's centre.
  const auto towards = [&](const Light& l, const glm::dvec3& at) {
    return glm::dot(l.direction, glm::normalize(scene_.origin - at));
  };
  EXPECT_NEAR(towards(light, light.position), towards(quad, place), 1e-9);
  EXPECT_GT(glm::length(light.side - quad.side), 0.1);
}

TEST_F(ControlsTest, LightScroll_Nearer_ChangesOnlyItsDistance) {
  Controls c = controls();
  c.scroll(-1.0, true);
  EXPECT_NEAR(c.view().lights[0].position.z, 2.0 * 0.9, 1e-12);
  EXPECT_NEAR(eyeOf(c).z, 4.0, 1e-12);
}

TEST_F(ControlsTest, Shading_TheBakeLacks_IsNotTaken) {
  Controls c = controls();
  c.setShading(Shading::Sh);
  EXPECT_EQ(c.view().shading, Shading::Phong);
  c.setShading(Shading::Ao);
  EXPECT_EQ(c.view().shading, Shading::Ao);
}

TEST_F(ControlsTest, AddLight_SelectsItAndNextGoesRound) {
  Controls c = controls();
  c.run(Command::AddLight);
  EXPECT_EQ(c.view().lights.size(), 2u);
  EXPECT_EQ(c.selectedLight(), 1);
  c.run(Command::NextLight);
  EXPECT_EQ(c.selectedLight(), 0);
}

TEST_F(ControlsTest, WithoutLights_LightCommandsDoNothing) {
  view_.lights.clear();
  Controls c = controls();
  c.drag(Drag::Light, {1, 1});
  c.scroll(1.0, true);
  c.run(Command::NextLight);
  c.setLightIntensity(glm::vec3(1));
  EXPECT_EQ(c.selectedLight(), -1);
}

TEST_F(ControlsTest, Groups_AreSelectedInTurnAndScaledByKeys) {
  Controls c{view_, scene_, [](Shading) { return true; }, {"lamp", "sign"}};
  EXPECT_EQ(c.selectedGroup(), 0);
  c.run(Command::NextGroup);
  for (int i = 0; i < 4; ++i) c.run(Command::BrightenGroup);
  EXPECT_EQ(c.view().groupFactors[0], glm::vec3(1));
  EXPECT_NEAR(c.view().groupFactors[1].g, 2.0f, 1e-6f);
  c.run(Command::DimGroup);
  EXPECT_LT(c.view().groupFactors[1].g, 2.0f);
  c.run(Command::NextGroup);
  EXPECT_EQ(c.selectedGroup(), 0);
}

TEST_F(ControlsTest, WithoutGroups_GroupCommandsDoNothing) {
  Controls c = controls();
  const std::size_t changes = c.changes();
  c.run(Command::NextGroup);
  c.run(Command::BrightenGroup);
  c.setGroupFactor(glm::vec3(2));
  EXPECT_EQ(c.selectedGroup(), -1);
  EXPECT_EQ(c.changes(), changes);
}

TEST_F(ControlsTest, Reset_AfterAnything_IsTheFirstCamera) {
  Controls c = controls();
  c.drag(Drag::Orbit, {0.3, 0.2});
  c.scroll(3.0, false);
  c.run(Command::ResetView);
  EXPECT_EQ(c.view().camera.world, view_.camera.world);
  EXPECT_EQ(c.view().camera.zNear, view_.camera.zNear);
}

TEST_F(ControlsTest, SkyDrag_FullTurn_StaysWithinPi) {
  Controls c = controls();
  c.drag(Drag::Sky, {1.5, 0.0});
  EXPECT_NEAR(c.view().skyRotation, -0.5 * pi, 1e-12);
}

TEST_F(ControlsTest, Occluders_AreCutToTheirRanges_AndCountAsChanges) {
  Controls c = controls();
  const std::size_t before = c.changes();
  c.setOptions({});
  EXPECT_EQ(c.changes(), before);
  ShadingOptions options;
  options.occluders.shading.shadowStrength = 1e9;
  options.occluders.shading.specularExponent = -3.0;
  options.occluders.shading.causticStrength = std::nan("");
  options.occluders.skyLights = 0;
  c.setOptions(options);
  EXPECT_GT(c.changes(), before);
  EXPECT_EQ(c.view().occluders.shading.shadowStrength, 100.0);
  EXPECT_EQ(c.view().occluders.shading.specularExponent, 1.0);
  EXPECT_EQ(c.view().occluders.shading.causticStrength, 1.0);
  EXPECT_EQ(c.view().occluders.skyLights, 1);
}

TEST_F(ControlsTest, Time_PassesWhereEffectsShow) {
  Controls c = controls();
  ShadingOptions options;
  c.setOptions(options);
  c.passTime(1.0);
  EXPECT_EQ(c.view().occluders.seconds, 0.0);
  options.occluders.shading.effects.fire = 0.5;
  c.setOptions(options);
  c.passTime(1.0);
  EXPECT_EQ(c.view().occluders.seconds, 0.0);  // Phong shading shows none.
  c.setShading(Shading::Vo);
  c.passTime(1.5);
  c.passTime(8.0);
  EXPECT_NEAR(c.view().occluders.seconds, 1.5, 1e-12);
}

}  // namespace
}  // namespace prelight::viewer
