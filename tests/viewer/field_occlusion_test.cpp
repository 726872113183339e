// Occlusion by fields around objects, compared with the closed form of a ball above a plane and with newly
// cast fields.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "scene/builtin/mesh_shapes.h"
#include "support/devices.h"
#include "viewer/core/camera.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/quad_scene.h"
#include "viewer/techniques/screen/fields/field_shapes.h"

namespace prelight {
namespace {

using namespace test;
using viewer::FieldShapes;
using viewer::OcclusionMethod;
using viewer::Shading;

constexpr double ballRadius = 0.3, ballHeight = 0.6;

/// Share of the sky that a ball with its centre at `ball` hides from a point of the floor: (r / d)^2 cos, as
/// all of the ball is above the horizon.
double hiddenByBall(const glm::dvec3& ball, const glm::dvec3& point) {
  const double distance = glm::distance(ball, point);
  return ballRadius * ballRadius * ball.z / (distance * distance * distance);
}

/// Balls above a floor z = 0, all instances of one mesh.
struct BallsOverFloor : QuadScene {
  explicit BallsOverFloor(const std::vector<glm::dvec3>& centres) {
    add(lambertian(glm::vec3(1)), 1.0f);
    const MeshShape sphere = makeSphere(static_cast<float>(ballRadius), 48, 24);
    Primitive primitive;
    for (const glm::vec3& p : sphere.positions)
      primitive.positions.push_back(p - glm::vec3(0, static_cast<float>(ballRadius), 0));
    primitive.normals = sphere.normals;
    primitive.triangles = sphere.triangles;
    primitive.material = 0;
    scene.meshes.push_back({"ball", {primitive}});
    for (const glm::dvec3& centre : centres) {
      const int node = static_cast<int>(scene.meshNodes.size());
      const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1.0), centre), 0.4 * node, {0, 0, 1});
      scene.meshNodes.push_back({node, "ball", 1, {place}});
    }
    setSky(constantEnvironment(glm::vec3(1)));
    lookFrom({0, -1.5, 0.35}, {0, 0, 0});
    compile();
  }

  viewer::RenderInputs inputs() const {
    viewer::RenderInputs with = QuadScene::inputs();
    with.device = &sharedDevice();
    return with;
  }

  double hiddenAt(const Picture& picture, const glm::dvec3& point) const {
    const viewer::CameraMatrices camera = viewer::cameraMatrices(scene.cameras.front(), compiled, 1.0);
    const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(point - compiled.origin, 1.0);
    return 1.0 - pixelAt(picture, 0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w).r;
  }
};

viewer::RenderOptions fieldOptions(double radius = 1.0) {
  viewer::RenderOptions options = square(Shading::Screen, 96);
  options.samplesPerAxis = 1;
  options.screenOcclusion.method = OcclusionMethod::Fields;
  options.screenOcclusion.radius = radius;
  options.screenOcclusion.fieldRays = 512;
  return options;
}

/// Visible places of the floor in front of and beside balls.
const std::vector<glm::dvec3> places = {
    {0, 0, 0}, {0.2, 0, 0}, {0, -0.3, 0}, {-0.4, -0.1, 0}, {0.3, -0.4, 0}};

Picture pictureOf(const BallsOverFloor& scene, const viewer::RenderOptions& options) {
  Warnings notes;
  return viewer::renderPicture(scene.inputs(), options, notes);
}

TEST(FieldOcclusion, BallOverFloor_HidesItsClosedForm) {
  const glm::dvec3 ball(0, 0, ballHeight);
  const BallsOverFloor scene({ball});
  const Picture picture = pictureOf(scene, fieldOptions());
  for (const glm::dvec3& point : places)
    EXPECT_NEAR(scene.hiddenAt(picture, point), hiddenByBall(ball, point), 0.012)
        << point.x << " " << point.y;
}

TEST(FieldOcclusion, TwoBalls_LeaveTheProductOfWhatEachLeaves) {
  const glm::dvec3 left(-0.35, 0, ballHeight), right(0.35, 0, ballHeight);
  const BallsOverFloor scene({left, right});
  const Picture picture = pictureOf(scene, fieldOptions());
  for (const glm::dvec3& point : places) {
    const double open = (1.0 - hiddenByBall(left, point)) * (1.0 - hiddenByBall(right, point));
    EXPECT_NEAR(scene.hiddenAt(picture, point), 1.0 - open, 0.02) << point.x << " " << point.y;
  }
}

TEST(FieldOcclusion, BallInTheAir_HidesNothingOfItself) {
  BallsOverFloor scene({{0, 0, 1.8}});
  scene.scene.cameras.clear();
  scene.lookFrom({0, -1.5, 1.8}, {0, 0, 1.8});
  EXPECT_NEAR(pixelAt(pictureOf(scene, fieldOptions(1.0))).r, 1.0, 0.01);
}

TEST(FieldOcclusion, BeyondTheRadius_HidesNothing) {
  const BallsOverFloor scene({{0, 0, ballHeight}});
  EXPECT_NEAR(scene.hiddenAt(pictureOf(scene, fieldOptions(0.2)), {0, 0, 0}), 0.0, 1e-4);
}

TEST(FieldOcclusion, MovedAndTurnedBall_HidesItsClosedFormFromWhereItIs) {
  BallsOverFloor scene({{-0.3, 0, ballHeight}});
  const viewer::gl::EglContext context;
  const viewer::RenderInputs inputs = scene.inputs();
  const viewer::View view = viewer::makeView(inputs, fieldOptions());
  viewer::Renderer renderer(inputs);
  const Picture before = viewer::renderView(renderer, view, 1);
  const glm::dvec3 ball(0.1, -0.1, ballHeight + 0.1);
  scene.scene.meshNodes[1].transforms = {
      glm::rotate(glm::translate(glm::dmat4(1.0), ball), 1.0, {0.6, 0, 0.8})};
  const CompiledScene rest = scene.compiled;
  scene.compile();
  for (glm::vec3& position : scene.compiled.positions)
    position += glm::vec3(scene.compiled.origin - rest.origin);
  scene.compiled.origin = rest.origin;
  renderer.sceneMoved();
  const Picture moved = viewer::renderView(renderer, view, 1);
  for (const glm::dvec3& point : places)
    EXPECT_NEAR(scene.hiddenAt(moved, point), hiddenByBall(ball, point), 0.015) << point.x << " " << point.y;
  EXPECT_GT(std::abs(scene.hiddenAt(before, {0.2, 0, 0}) - scene.hiddenAt(moved, {0.2, 0, 0})), 0.05);
}

TEST(FieldOcclusion, SceneWithoutOccluders_IsOpen) {
  Material pane = lambertian(glm::vec3(1));
  pane.alphaMode = AlphaMode::Blend;
  pane.baseColor.a = 0.5f;
  QuadScene scene;
  scene.add(pane);
  scene.lookFrom({0, 0, 2}, {0, 0, 0});
  scene.setSky(constantEnvironment(glm::vec3(1)));
  scene.compile();
  EXPECT_NEAR(pixelAt(scene.render(fieldOptions())).r, 1.0, 1e-4);
}

TEST(FieldShapes, TurnedDrawingsOfAMesh_ShareAShape_ScaledOnesDoNot) {
  BallsOverFloor scene({{-0.8, 0, 0.6}, {0, 0, 0.6}, {0.8, 0, 0.6}});
  scene.scene.meshNodes[2].transforms = {
      glm::scale(scene.scene.meshNodes[2].transforms.front(), {1.5, 1, 1})};
  scene.compile();
  const FieldShapes shapes(scene.compiled, sharedDevice(), {.radius = 0.5, .cells = 512, .rays = 16});
  ASSERT_EQ(shapes.objects().size(), 4u);
  EXPECT_EQ(shapes.shapes().size(), 3u);  // The floor, the balls, and the longer one.
  EXPECT_EQ(shapes.objects()[3].shape, shapes.objects()[1].shape);
  EXPECT_NE(shapes.objects()[2].shape, shapes.objects()[1].shape);
}

}  // namespace
}  // namespace prelight
