// Scenes that windows play and whose nodes are dragged, compared with pictures of scenes in that state.
#include "viewer/follow/posed_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "bake/animated_bake.h"
#include "bake/make_plan.h"
#include "gi/global_illumination.h"
#include "occluders/posed_occluders.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/bent_bar.h"
#include "support/run_bake.h"
#include "techniques/registry/keyed_bake.h"
#include "viewer/follow/frames.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/window/scene_follower.h"

namespace prelight::viewer {
namespace {

using test::largestDifference;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double restless = 1e-4;  ///< Least difference between pictures of different states.

/// Index into Scene::nodes.
std::size_t nodeOf(const Scene& scene, const std::string& name) {
  return std::find_if(scene.meshNodes.begin(), scene.meshNodes.end(),
                      [&](const MeshNode& node) { return node.name == name; })
      ->sceneNode;
}

/// The built-in animated scene. Few rays are enough, because pictures are only compared with one another.
struct Swing {
  Scene scene;
  CompiledScene compiled;
  Bake bake;

  Swing() {
    Warnings warnings;
    scene = loadScene(makeBuiltinScene("swing"), warnings);
    addMotion();
    compiled = compileScene(scene, warnings);
    BakeRequest request;
    request.effort.rays = 4;
    request.sh.order = 3;
    request.bounces = 1;
    request.ao = request.occluders.wanted = true;
    bake = test::runBake(compiled, request).bake;
    KeyRequest keys;
    keys.count = 3;
    Progress progress;
    AnimationReport report;
    request.ao = false;
    request.occluders = {};
    bake.animation =
        bakeAnimation(scene, compiled, 0, request, keys, bake, test::sharedDevice(), progress, report);
  }

  /// Animates the camera, a light that hangs on the ball, the ball's colour and metalness, and the lamp.
  void addMotion() {
    Animation& animation = scene.animations[0];
    const glm::dvec3 eye(scene.cameras[0].world[3]);
    animation.channels.push_back(
        {scene.cameras[0].sceneNode, AnimatedPath::Translation, animation.samplers.size()});
    animation.samplers.push_back({Interpolation::Linear,
                                  {0, 4},
                                  {glm::vec4(eye, 0.0f), glm::vec4(eye + glm::dvec3(0.5, 0.3, -0.4), 0.0f)}});
    Light light;
    light.intensity = glm::vec3(4.0f);
    light.sceneNode = nodeOf(scene, "Ball");
    placeLight(light, glm::translate(glm::dmat4(1.0), scene.nodes[light.sceneNode].translation));
    scene.lights.push_back(light);
    const auto change = [&](const std::string& material, AnimatedProperty property, const glm::vec4& from,
                            const glm::vec4& to) {
      const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                      [&](const Material& m) { return m.name == material; });
      const auto object = static_cast<std::size_t>(found - scene.materials.begin());
      animation.properties.push_back({property, object, animation.samplers.size(), from});
      animation.samplers.push_back({Interpolation::Linear, {0, 4}, {from, to}});
    };
    change("Red", AnimatedProperty::BaseColor, {0.75f, 0.15f, 0.12f, 1.0f}, {0.1f, 0.2f, 0.8f, 1.0f});
    change("Red", AnimatedProperty::Metallic, glm::vec4(0.0f), glm::vec4(1.0f));
    change("Lamp", AnimatedProperty::Emission, {30.0f, 28.0f, 24.0f, 0.0f}, {10.0f, 20.0f, 30.0f, 0.0f});
  }

  RenderInputs inputs() const { return {.scene = scene, .compiled = compiled, .bake = &bake}; }
};

const Swing& swing() {
  static const Swing scene;
  return scene;
}

RenderOptions optionsOf(Shading shading) {
  RenderOptions options;
  options.shading = shading;
  options.width = 96;
  options.height = 72;
  options.samplesPerAxis = 1;
  return options;
}

/// A picture of a scene that is in this pose from the start.
Picture still(const Scene& posed, std::optional<double> seconds, Shading shading) {
  const Swing& rest = swing();
  Warnings warnings;
  const CompiledScene compiled = compileScene(posed, warnings);
  Bake bake;
  if (seconds) bake = bakeAt(*rest.bake.animation, posed, compiled, *seconds);
  if (shading == Shading::Vo) {  // lobes see the sky that is open at rest
    bake.ao = rest.bake.ao;
    bake.bentNormals = rest.bake.bentNormals;
  }
  const OccluderMembers members = *membersOf(rest.compiled, *rest.bake.occluders);
  bake.occluders = OccluderMover(*rest.bake.occluders, rest.compiled, members)
                       .moved(motionsBetween(posed, compiled, members, transformsOf(rest.scene).nodes,
                                             transformsOf(posed).nodes, rest.bake.occluders->names));
  return renderPicture({.scene = posed, .compiled = compiled, .bake = &bake}, optionsOf(shading), warnings);
}

Picture stillAt(double seconds, Shading shading) {
  return still(sceneAt(swing().scene, 0, seconds), seconds, shading);
}

/// Everything between a window's controls and its pictures, with its own OpenGL context.
class Stage {
 public:
  explicit Stage(Shading shading, const RenderInputs& inputs = swing().inputs())
      : scene(inputs),
        renderer(scene.shown()),
        follower(renderer, scene, {}),
        controls(
            makeView(inputs, optionsOf(shading)), inputs.compiled,
            [this](Shading s) { return renderer.canShade(s); }, {}, dragNodes(scene)) {
    controls.startFollowing({scene.lights(), scene.cameras()}, {true, 0});
    controls.setPlayback(Playback(inputs.scene));
  }

  Picture frame() {
    follower.update(controls);
    return renderView(renderer, controls.view(), 1);
  }

  gl::EglContext context;
  PosedScene scene;
  Renderer renderer;
  SceneFollower follower;
  Controls controls;
};

class PlayedScene : public testing::TestWithParam<Shading> {};

TEST_P(PlayedScene, Frames_ForwardsBackwardsAndAtKeys_AreTheStillPictures) {
  const std::vector<double> moments = {0.3, 1.0, 1.7, 2.0, 3.9, 3.1, 1.7, 0.1};
  std::vector<Picture> stills;
  for (const double seconds : moments) stills.push_back(stillAt(seconds, GetParam()));
  EXPECT_GT(largestDifference(stills[0], stills[2]), restless) << "nothing moves";
  Stage stage(GetParam());
  for (std::size_t i = 0; i < moments.size(); ++i) {
    stage.controls.seek(moments[i]);
    EXPECT_EQ(largestDifference(stage.frame(), stills[i]), 0.0) << moments[i] << " s";
  }
  EXPECT_THAT(stage.scene.takeNotes(), IsEmpty());
}

TEST_P(PlayedScene, BeforeItPlays_IsThePictureOfItsInputs) {
  Warnings notes;
  const Picture first = renderPicture(swing().inputs(), optionsOf(GetParam()), notes);
  Stage stage(GetParam());
  EXPECT_EQ(largestDifference(stage.frame(), first), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Shadings, PlayedScene, testing::Values(Shading::Phong, Shading::Sh, Shading::Vo),
                         [](const auto& info) { return std::string(shadingName(info.param)); });

TEST(PlayedScene, ShadingSwitchedWhileItStands_IsOfTheSameMoment) {
  const Picture vo = stillAt(2.6, Shading::Vo), sh = stillAt(2.6, Shading::Sh);
  Stage stage(Shading::Sh);
  stage.controls.seek(1.0);
  stage.frame();
  stage.controls.setShading(Shading::Vo);
  stage.frame();
  stage.controls.seek(2.6);
  EXPECT_EQ(largestDifference(stage.frame(), vo), 0.0);
  stage.controls.setShading(Shading::Sh);
  EXPECT_EQ(largestDifference(stage.frame(), sh), 0.0);
  stage.controls.setShading(Shading::Vo);
  EXPECT_EQ(largestDifference(stage.frame(), vo), 0.0);
}

/// Index of a node that can be dragged.
std::size_t nodeNamed(const PosedScene& scene, const std::string& name) {
  const auto& nodes = scene.nodes();
  return static_cast<std::size_t>(
      std::find_if(nodes.begin(), nodes.end(), [&](const auto& n) { return n.name == name; }) -
      nodes.begin());
}

TEST(DraggedScene, NodesInVo_AreThoseOfAPictureWithThemThere_AndBackAgain) {
  Scene posed = swing().scene;
  for (MeshNode& node : posed.meshNodes)
    if (node.name == "Ball" || node.name == "Box")
      for (glm::dmat4& transform : node.transforms)
        transform = glm::translate(glm::dmat4(1.0), node.name == "Ball" ? glm::dvec3(1.5, 0.25, 0.0)
                                                                        : glm::dvec3(0.0, 0.0, 1.0)) *
                    transform;
  const Picture moved = still(posed, std::nullopt, Shading::Vo);
  Warnings notes;
  const Picture rest = renderPicture(swing().inputs(), optionsOf(Shading::Vo), notes);
  ASSERT_GT(largestDifference(moved, rest), restless);
  Stage stage(Shading::Vo);
  View view = stage.controls.view();
  view.nodeShifts[nodeNamed(stage.scene, "Ball")] = {1.5, 0.25, 0.0};
  view.nodeShifts[nodeNamed(stage.scene, "Box")] = {0.0, 0.0, 1.0};
  const auto show = [&](const View& shown) {
    showPose(stage.scene, stage.renderer, {shown.moment, shown.nodeShifts}, shown.shading);
    return renderView(stage.renderer, shown, 1);
  };
  EXPECT_LT(largestDifference(show(view), moved), 1e-5);
  for (glm::dvec3& way : view.nodeShifts) way = glm::dvec3(0.0);
  EXPECT_EQ(largestDifference(show(view), rest), 0.0);
}

/// The scene `swing` with its ball scaled to `last` within 4 s.
Scene scaled(const glm::vec4& last) {
  Scene scene = swing().scene;
  Animation& animation = scene.animations[0];
  animation.channels.push_back({nodeOf(scene, "Ball"), AnimatedPath::Scale, animation.samplers.size()});
  animation.samplers.push_back({Interpolation::Linear, {0, 4}, {glm::vec4(1.0f), last}});
  return scene;
}

TEST(PlayedScene, OccludersThatDoNotMoveRigidly_StayAndSaySoOnce) {
  const Scene scene = scaled({2.0f, 2.0f, 2.0f, 0.0f});
  RenderInputs inputs{.scene = scene, .compiled = swing().compiled, .bake = &swing().bake};
  PosedScene posed(inputs);
  EXPECT_TRUE(posed.pose({SceneMoment{0, 1.0}, {}}, Shading::Vo).bake);
  EXPECT_FALSE(posed.shown().posed->occluders);
  EXPECT_THAT(posed.takeNotes(), ElementsAre(HasSubstr("\"Ball\" is scaled")));
  posed.pose({SceneMoment{0, 1.2}, {}}, Shading::Vo);
  EXPECT_THAT(posed.takeNotes(), IsEmpty());
}

TEST(PlayedScene, ShadingWhoseBakeIsOfOnePose_SaysThatItStays) {
  PosedScene posed(swing().inputs());
  posed.pose({SceneMoment{0, 1.0}, {}}, Shading::Ao);
  EXPECT_THAT(posed.takeNotes(), ElementsAre(HasSubstr("ao shading stays as it was baked")));
}

TEST(PlayedScene, WithoutKeys_KeepsTheTransferAndSaysSo) {
  Bake bake;
  bake.sh = swing().bake.sh;
  RenderInputs inputs{.scene = swing().scene, .compiled = swing().compiled, .bake = &bake};
  PosedScene posed(inputs);
  posed.pose({SceneMoment{0, 1.0}, {}}, Shading::Sh);
  EXPECT_FALSE(posed.shown().posed->sh);
  EXPECT_THAT(posed.takeNotes(), ElementsAre(HasSubstr("no keys")));
}

/// A scene whose ball is a child of its box.
Scene hanging() {
  Scene scene = swing().scene;
  scene.nodes[nodeOf(scene, "Ball")].parent = static_cast<int>(nodeOf(scene, "Box"));
  return scene;
}

TEST(DraggedScene, WhatHangsOnANode_GoesAlong_WhereCoordinatesStayToo) {
  const Scene scene = hanging();
  const GlobalIllumination light;
  for (const GlobalIllumination* full : {static_cast<const GlobalIllumination*>(nullptr), &light}) {
    RenderInputs inputs{.scene = scene, .compiled = swing().compiled};
    inputs.globalIllumination = full;
    PosedScene posed(inputs);
    const std::size_t box = nodeNamed(posed, "Box"), ball = nodeNamed(posed, "Ball");
    ASSERT_LT(box, ball);
    ScenePlace place;
    place.ways.assign(posed.nodes().size(), glm::dvec3(0.0));
    place.ways[box] = {1.0, 0.0, 0.0};
    place.ways[ball] = {0.0, 0.5, 0.0};
    EXPECT_TRUE(posed.pose(place, Shading::Phong).places);
    EXPECT_EQ(posed.shifts()[ball].by, glm::dvec3(1.0, 0.5, 0.0));
    const CompiledScene& now = posed.shown().compiled;
    const auto range = std::find_if(now.primitives.begin(), now.primitives.end(),
                                    [](const PrimitiveRange& r) { return r.name == "Ball"; });
    const glm::dvec3 before =
        swing().compiled.origin + glm::dvec3(swing().compiled.positions[range->firstVertex]);
    const glm::dvec3 after = now.origin + glm::dvec3(now.positions[range->firstVertex]);
    EXPECT_LT(glm::length(after - before - glm::dvec3(1.0, 0.5, 0.0)), 1e-6);
    EXPECT_TRUE(posed.showsMoments());
    EXPECT_EQ(now.origin == swing().compiled.origin, full != nullptr);
  }
}

/// A bar that a skin bends and a morph target thickens, seen by a fixed camera.
Scene bending() {
  Warnings warnings;
  Scene scene = loadScene(test::bentBar(), warnings);
  Primitive& bar = scene.meshes[0].primitives[0];
  bar.targets.emplace_back().positions.assign(bar.positions.size(), glm::vec3(0.1f, 0.2f, 0.3f));
  bar.targets[0].normals.assign(bar.positions.size(), glm::vec3(0.0f, 0.0f, 2.0f));
  MeshNode& node = scene.meshNodes[0];
  node.restWeights = node.weights = {0.0f};
  Animation& animation = scene.animations[0];
  animation.channels.push_back({node.sceneNode, AnimatedPath::Weights, animation.samplers.size()});
  AnimationSampler& weights = animation.samplers.emplace_back();
  weights.times = {0, 1};
  weights.weights = {0, 1};
  weights.targets = 1;
  Camera& camera = scene.cameras.emplace_back();
  camera.world = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1.0, 5.0));
  camera.sceneNode = scene.nodes.size();
  Light& light = scene.lights.emplace_back();
  light.type = LightType::Directional;
  light.direction = glm::normalize(glm::dvec3(-1.0, 0.0, -1.0));
  return scene;
}

/// Expects that frames of a scene without a bake equal its still pictures.
void expectStills(const Scene& scene, const std::vector<double>& moments) {
  Warnings notes;
  std::vector<Picture> stills;
  for (const double seconds : moments) {
    const Scene posed = sceneAt(scene, 0, seconds);
    const CompiledScene compiled = compileScene(posed, notes);
    stills.push_back(renderPicture({.scene = posed, .compiled = compiled}, optionsOf(Shading::Phong), notes));
  }
  ASSERT_GT(largestDifference(stills[0], stills[1]), restless);
  const CompiledScene compiled = compileScene(scene, notes);
  Stage stage(Shading::Phong, {.scene = scene, .compiled = compiled});
  for (std::size_t i = 0; i < moments.size(); ++i) {
    stage.controls.seek(moments[i]);
    EXPECT_EQ(largestDifference(stage.frame(), stills[i]), 0.0) << moments[i] << " s";
  }
}

TEST(PlayedScene, BentAndMorphedVertices_AreWhereStillPicturesHaveThem) {
  expectStills(bending(), {0.8, 0.2, 0.5});
}

TEST(PlayedScene, BentTransferWithoutKeys_FollowsAndComesBack) {
  const Scene scene = bending();
  Warnings warnings;
  const CompiledScene compiled = compileScene(scene, warnings);
  BakeRequest request;
  request.effort.rays = 4;
  request.sh.order = 2;
  const Bake bake = test::runBake(compiled, request).bake;
  PosedScene played({.scene = scene, .compiled = compiled, .bake = &bake});
  const BentBake bent(bake, compiled);
  for (const double seconds : {0.7, 0.3}) {
    EXPECT_TRUE(played.pose({SceneMoment{0, seconds}, {}}, Shading::Sh).bake);
    const CompiledScene there = compileScene(sceneAt(scene, 0, seconds), warnings);
    ASSERT_TRUE(played.shown().posed->sh);
    EXPECT_EQ(played.shown().posed->sh->coefficients, bent.at(there).sh->coefficients);
    EXPECT_NE(played.shown().posed->sh->coefficients, bake.sh->coefficients);
  }
  EXPECT_THAT(played.takeNotes(), ElementsAre(HasSubstr("skins and morphs bend")));
  played.pose({}, Shading::Sh);
  EXPECT_FALSE(played.shown().posed->sh) << "the bake's own transfer holds again";
}

TEST(PlayedScene, NodeThatIsFlattenedAndTurnedInsideOut_IsTheStillPicture) {
  expectStills(scaled({-1.0f, 1.0f, 1.0f, 0.0f}), {0.5, 3.0, 2.0, 1.0});
}

TEST(RenderFrames, OfAnAnimation_AreItsStillPictures) {
  const std::vector<SceneMoment> moments = {{0, 0.5}, {0, 1.5}, {0, 1.0}};
  std::vector<Picture> frames;
  Warnings notes;
  renderFrames(
      swing().inputs(), optionsOf(Shading::Vo), {}, moments,
      [&](std::size_t frame, const Picture& picture, const std::vector<PictureChannel>&) {
        EXPECT_EQ(frame, frames.size());
        frames.push_back(picture);
      },
      notes);
  ASSERT_EQ(frames.size(), moments.size());
  for (std::size_t i = 0; i < moments.size(); ++i)
    EXPECT_EQ(largestDifference(frames[i], stillAt(moments[i].seconds, Shading::Vo)), 0.0);
}

}  // namespace
}  // namespace prelight::viewer
