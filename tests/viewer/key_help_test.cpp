#include "viewer/window/key_help.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace prelight::viewer {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> helpOf(std::set<Shading> shadings, std::size_t lights,
                                std::vector<std::string> groups, std::vector<DragNode> nodes, bool hasSky) {
  CompiledScene scene;
  scene.boundsMin = glm::vec3(-1);
  scene.boundsMax = glm::vec3(1);
  View view;
  view.camera.world = glm::dmat4(1.0);
  view.lights.resize(lights);
  const Controls controls(
      view, scene, [&](Shading shading) { return shadings.count(shading) > 0; }, std::move(groups),
      std::move(nodes));
  return keyHelp(controls, hasSky);
}

TEST(KeyHelp, PlainFile_LeavesOutWhatNeedsLightsNodesGroupsAndSky) {
  const auto lines = helpOf({Shading::Phong}, 0, {}, {}, false);
  EXPECT_THAT(lines, Contains(HasSubstr("orbit")));
  EXPECT_THAT(lines, Contains(HasSubstr("add a light")));
  EXPECT_THAT(lines, Contains(HasSubstr("1 phong")));
  for (const char* absent : {"selected", "next", "sky", "full", "brighter", ", 2 ", "sh"})
    EXPECT_THAT(lines, Not(Contains(HasSubstr(absent)))) << absent;
}

TEST(KeyHelp, FileWithEverything_ListsEveryKey) {
  std::set<Shading> all;
  for (const ShadingInfo& info : shadings()) all.insert(info.shading);
  const auto lines = helpOf(all, 2, {"a", "b"}, {{"box", {}}, {"ball", {}}}, true);
  for (const char* key :
       {"right drag", "Tab", "Shift + left drag", "N ", "Shift + right drag", "F ", "G ", "PgUp"})
    EXPECT_THAT(lines, Contains(testing::StartsWith(key))) << key;
  EXPECT_THAT(lines,
              Contains(HasSubstr("3 sh, 4 ch, 5 haar, 6 glossy, 7 lights, 8 vo, 9 radiosity, 0 lightmap")));
}

TEST(KeyHelp, OneLightAndOneGroup_OffersNoNextOne) {
  const auto lines = helpOf({Shading::Phong, Shading::Lights}, 1, {"lamp"}, {}, false);
  EXPECT_THAT(lines, Contains(HasSubstr("move the selected light")));
  EXPECT_THAT(lines, Contains(HasSubstr("brighter")));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("next"))));
}

TEST(KeyHelp, Nodes_NameTheShadingsThatFollowThem) {
  EXPECT_THAT(helpOf({Shading::Phong, Shading::Vo}, 0, {}, {{"box", {}}}, false),
              Contains(HasSubstr("move the selected node (vo shading)")));
  EXPECT_THAT(helpOf({Shading::Vo, Shading::GlobalIllumination}, 0, {}, {{"box", {}}}, false),
              Contains(HasSubstr("(full and vo shading)")));
  EXPECT_THAT(helpOf({Shading::Phong}, 0, {}, {{"box", {}}}, false), Not(Contains(HasSubstr("node"))));
}

TEST(KeyHelp, Animation_HasItsKeys) {
  CompiledScene compiled;
  View view;
  view.camera.world = glm::dmat4(1.0);
  Scene scene;
  scene.nodes.resize(1);
  Animation& animation = scene.animations.emplace_back();
  animation.samplers.push_back({Interpolation::Linear, {0, 2}, std::vector<glm::vec4>(2)});
  animation.channels.push_back({0, AnimatedPath::Translation, 0});
  Controls controls(view, compiled, [](Shading) { return true; });
  EXPECT_THAT(keyHelp(controls, false), Not(Contains(HasSubstr("animation"))));
  controls.setPlayback(Playback(scene));
  for (const char* key : {"Space", "Left, Right", "[ and ]", "Home"})
    EXPECT_THAT(keyHelp(controls, false), Contains(testing::StartsWith(key))) << key;
}

TEST(ShadingOfKey, NumberKeys_NameTheFirstTenShadingsInOrder) {
  EXPECT_EQ(shadingOfKey(1), Shading::Phong);
  EXPECT_EQ(shadingOfKey(9), Shading::Radiosity);
  EXPECT_EQ(shadingOfKey(0), Shading::LightMap);
}

}  // namespace
}  // namespace prelight::viewer
