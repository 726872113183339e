// Light of objects by cube maps: their projection against closed forms and double precision, and what objects
// show against integrals over the scene around them.
#include "viewer/cubes/object_cubes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "basis/sh.h"
#include "basis/sh_projection.h"
#include "prelight/error.h"
#include "receivers/sampling.h"
#include "support/scenes.h"
#include "viewer/cubes/cube_faces.h"
#include "viewer/cubes/cube_projection.h"
#include "viewer/drawn_passes.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using std::numbers::pi;
using viewer::CubeProjection;
using viewer::Shading;

constexpr int side = 16;

CubeMap cubeOf(const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
  CubeMap cube{side, {}};
  for (std::uint32_t t = 0; t < cubeTexelCount(side); ++t)
    cube.radiance.push_back(radiance(cubeTexelDirection(t, side)));
  return cube;
}

/// Coefficients [i] of the second of two cubes, projected by OpenGL.
std::vector<glm::vec4> projected(const CubeMap& cube, int order) {
  const viewer::gl::EglContext context;
  const viewer::gl::Texture maps = viewer::makeCubeMaps(side, 2, false);
  std::vector<glm::vec4> texels;
  for (const glm::vec3& radiance : cube.radiance) texels.emplace_back(radiance, 7.0f);
  glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, maps.name());
  glTexSubImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, 0, 0, 0, 6, side, side, 6, GL_RGBA, GL_FLOAT, texels.data());
  const CubeProjection projection(side, 2, order);
  projection.project(maps, 1);
  const std::vector<glm::vec4> both = projection.target().read();
  return {both.begin() + order * order, both.end()};
}

TEST(CubeProjection, ConstantRadiance_IsItsMeanAlone) {
  const glm::vec3 radiance(0.5f, 2.0f, 7.0f);
  const std::vector<glm::vec4> found = projected(cubeOf([&](const glm::dvec3&) { return radiance; }), 4);
  ASSERT_EQ(found.size(), 16u);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[i][c], i == 0 ? std::sqrt(4.0 * pi) * radiance[c] : 0.0, 2e-5 * radiance[c]) << i;
}

// The clamped cosine about n has the coefficients A_l Y_lm(n), with A = pi, 2 pi / 3, pi / 4, 0 (Ramamoorthi
// and Hanrahan 2001, Eq. 8).
TEST(CubeProjection, CosineLobe_IsItsClosedForm) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.4, -0.7, 0.5));
  const CubeMap cube =
      cubeOf([&](const glm::dvec3& w) { return glm::vec3(glm::dvec3(std::max(glm::dot(n, w), 0.0))); });
  const std::vector<glm::vec4> found = projected(cube, 4);
  std::vector<double> values(16);
  sh::evaluate(n, 4, values);
  constexpr std::array<double, 4> lobes = {pi, 2.0 * pi / 3.0, pi / 4.0, 0.0};
  for (std::size_t i = 0; i < 16; ++i) {
    const auto l = static_cast<std::size_t>(std::sqrt(double(i)));
    EXPECT_NEAR(found[i].x, lobes[l] * values[i], 4e-3) << i;  // Texels are 6 degrees wide.
  }
}

TEST(CubeProjection, AnyRadiance_IsThatOfDoublePrecision) {
  const CubeMap cube = cubeOf([](const glm::dvec3& w) {
    return glm::vec3(1.0 + std::sin(9.0 * w.x + 3.0 * w.y), std::exp(2.0 * w.z), w.y > 0.3 ? 5.0 : 0.1);
  });
  for (const int order : {1, 3, 4}) {
    const std::vector<glm::vec4> found = projected(cube, order);
    const std::vector<double> expected = sh::projectEnvironment(cube, order);
    const auto count = static_cast<std::size_t>(order * order);
    ASSERT_EQ(found.size(), count);
    for (std::size_t i = 0; i < 3 * count; ++i)
      EXPECT_NEAR(found[i % count][static_cast<int>(i / count)], expected[i], 2e-5) << order << " " << i;
  }
}

TEST(CubeProjection, OtherOrders_AreUsageErrors) {
  const viewer::gl::EglContext context;
  EXPECT_THROW(CubeProjection(side, 1, 0), UsageError);
  EXPECT_THROW(CubeProjection(side, 1, 5), UsageError);
  EXPECT_THROW(CubeProjection(12, 1, 3), UsageError);
}

constexpr double roomHalf = 2.0;
constexpr float ballRadius = 0.1f;

/// Radiance of the walls of a room [-roomHalf, roomHalf]^3: -x, +x, -y, +y, -z, +z.
constexpr std::array<glm::vec3, 6> walls = {glm::vec3(1, 0.5, 0.5), glm::vec3(0.5, 1, 0.5),
                                            glm::vec3(0.5, 0.5, 1), glm::vec3(1, 1, 0.2),
                                            glm::vec3(0.2, 1, 1),   glm::vec3(1, 0.2, 1)};

/// A small white ball without a bake.
struct LoneBall {
  QuadScene quad;
  VertexRange range;

  void addRoom() {
    for (int i = 0; i < 6; ++i) {
      Material wall = lambertian(glm::vec3(0.0f));
      wall.emission = walls[static_cast<std::size_t>(i)];
      const int axis = i / 2;
      glm::dvec3 inward(0.0), x(0.0);
      inward[axis] = i % 2 == 0 ? 1.0 : -1.0;
      x[(axis + 1) % 3] = 1.0;
      const glm::dvec3 y = glm::cross(inward, x);
      quad.add(wall, float(roomHalf),
               glm::dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(inward, 0),
                          glm::dvec4(-roomHalf * inward, 1)));
    }
  }

  /// Adds the ball as the last primitive, seen from `eye`.
  void addBall(const glm::vec3& center, const glm::dvec3& eye) {
    Primitive& ball = quad.add(lambertian(glm::vec3(1.0f)));
    const CompiledScene sphere = test::sphere(32, ballRadius, center);
    ball.positions = sphere.positions;
    ball.normals.clear();
    for (const glm::vec3& p : sphere.positions) ball.normals.push_back(glm::normalize(p - center));
    ball.triangles = sphere.triangles;
    ball.texCoords0.clear();
    quad.lookFrom(eye, center);
    quad.compile();
    const PrimitiveRange& last = quad.compiled.primitives.back();
    range = {last.firstVertex, last.vertexCount, last.firstTriangle, last.triangleCount};
  }

  viewer::RenderInputs inputs() const {
    viewer::RenderInputs inputs = quad.inputs();
    inputs.cubeLit = std::span(&range, 1);
    return inputs;
  }
};

viewer::RenderOptions phong(bool emitters) {
  viewer::RenderOptions options = square(Shading::Phong, 33);
  options.samplesPerAxis = 1;
  options.emitters = emitters;
  return options;
}

/// Irradiance over pi from the walls of the room at a place, by cosine-weighted directions.
glm::dvec3 irradianceInRoom(const glm::dvec3& from, const glm::dvec3& normal) {
  constexpr std::uint32_t ways = 1u << 14;
  glm::dvec3 sum(0.0);
  for (std::uint32_t k = 0; k < ways; ++k) {
    const glm::dvec3 way = sampling::cosineHemisphere(sampling::sobol(k, 5), normal);
    double nearest = 1e30;
    std::size_t wall = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = ((way[axis] > 0.0 ? roomHalf : -roomHalf) - from[axis]) / way[axis];
      if (!(along < nearest)) continue;
      nearest = along;
      wall = static_cast<std::size_t>(2 * axis + (way[axis] > 0.0 ? 1 : 0));
    }
    sum += glm::dvec3(walls[wall]);
  }
  return sum / double(ways);
}

// With three bands a cosine lobe is off by at most 6 %, and walls of few colours by less.
TEST(ObjectCubes, BallAmongShiningWalls_ShowsTheirIntegral) {
  const glm::vec3 center(0.7f, -0.4f, 0.9f);
  for (const glm::dvec3 away : {glm::dvec3(0.9, 0, 0), glm::dvec3(0, -0.8, 0), glm::dvec3(0.5, 0.4, 0.6)}) {
    LoneBall ball;
    ball.addRoom();
    ball.addBall(center, glm::dvec3(center) + away);
    Warnings notes;
    const Picture picture = viewer::renderPicture(ball.inputs(), phong(false), notes);
    expectColor(pixelAt(picture), irradianceInRoom(center, glm::normalize(away)), 0.03);
  }
}

// The part of the light that an object hides from itself is subtracted, by channel.
TEST(ObjectCubes, OpennessOfVertices_ScalesWhatTheyGet) {
  LoneBall ball;
  ball.addRoom();
  ball.addBall({0.7f, -0.4f, 0.9f}, {1.6, -0.4, 0.9});
  Warnings notes;
  const Picture open = viewer::renderPicture(ball.inputs(), phong(false), notes);
  const std::vector<glm::vec3> openness(ball.range.vertexCount, glm::vec3(0.5f, 0.75f, 1.0f));
  viewer::RenderInputs inputs = ball.inputs();
  inputs.cubeOpenness = openness;
  const Picture hidden = viewer::renderPicture(inputs, phong(false), notes);
  expectColor(pixelAt(hidden), glm::dvec3(openness[0] * pixelAt(open)), 1e-5);
  EXPECT_EQ(pixelAt(hidden, 0.02, 0.02), pixelAt(open, 0.02, 0.02)) << "the wall behind";
}

// A window spreads small changes over several pictures, and ends with the result of a single picture.
TEST(ObjectCubes, BallThatMoved_ShowsWhatOneThereShows) {
  const glm::dvec3 eye(0.2, 0.1, 1.4);
  const viewer::gl::EglContext context;
  LoneBall ball, there;
  ball.addRoom();
  ball.addBall({0.2f, 0.1f, 0.0f}, eye);
  there.addRoom();
  there.addBall({0.2f, 0.1f, -0.5f}, eye);
  const viewer::RenderInputs inputs = ball.inputs();
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  const viewer::View view = viewer::makeView(inputs, phong(false));
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.faces(), 6u);
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.faces(), 0u) << "nothing has changed";
  renderer.paceUpdates(true);
  for (int step = 0; step < 10; ++step) {
    for (std::uint32_t v = 0; v < ball.range.vertexCount; ++v)
      ball.quad.compiled.positions[ball.range.firstVertex + v].z -= 0.05f;
    renderer.sceneMoved();
    viewer::renderView(renderer, view, 1);
    // When it is more than half its radius away from where its faces were drawn, the ball gets all six faces
    // anew.
    EXPECT_EQ(drawn.faces(), step % 2 == 0 ? 2u : 6u) << step;
  }
  while (renderer.isBehind()) viewer::renderView(renderer, view, 1);
  viewer::Renderer fresh(there.inputs());
  const viewer::View seen = viewer::makeView(there.inputs(), phong(false));
  EXPECT_LT(largestDifference(viewer::renderView(renderer, view, 1), viewer::renderView(fresh, seen, 1)),
            2e-3);
}

// A point light of intensity I at distance r gives irradiance I / r^2. A plate in between blocks all of it,
// and a plate behind the light nothing.
TEST(ObjectCubes, Lamp_ShinesWhereNothingIsBetween) {
  const glm::dvec3 eye(0, 0, 1.5), lamp(0, 1.5, 1.5);
  Material black = lambertian(glm::vec3(0.0f));
  black.doubleSided = true;
  const auto middleOf = [&](bool plate, double share) {
    LoneBall ball;
    if (plate)
      ball.quad.add(black, 0.3f,
                    glm::translate(glm::dmat4(1.0), share * lamp) *
                        glm::rotate(glm::dmat4(1.0), -0.7853981633974483, glm::dvec3(1, 0, 0)));
    ball.quad.scene.lights.push_back(makeLight(LightType::Point, glm::vec3(8.0f), lamp));
    ball.addBall({0, 0, 0}, eye);
    Warnings notes;
    return pixelAt(viewer::renderPicture(ball.inputs(), phong(true), notes));
  };
  const glm::dvec3 path = lamp - glm::dvec3(0, 0, ballRadius);
  const double expected = 8.0 / pi * path.z / std::pow(glm::length(path), 3.0);
  expectColor(middleOf(false, 0.0), glm::dvec3(expected), 0.01);
  expectColor(middleOf(true, 0.5), glm::dvec3(0.0), 0.01);
  expectColor(middleOf(true, 1.4), glm::dvec3(expected), 0.01);
}

// A plate towards the sun hides it at every distance.
TEST(ObjectCubes, Sun_ShinesWhereNothingIsBetween) {
  const glm::dvec3 eye(0, 0, 1.5), toSun = glm::normalize(glm::dvec3(0, 1, 1));
  Material black = lambertian(glm::vec3(0.0f));
  black.doubleSided = true;
  const auto middleOf = [&](const glm::dvec3& plate) {
    LoneBall ball;
    ball.quad.add(black, 0.3f,
                  glm::translate(glm::dmat4(1.0), plate) *
                      glm::rotate(glm::dmat4(1.0), -0.7853981633974483, glm::dvec3(1, 0, 0)));
    ball.quad.scene.lights.push_back(makeLight(LightType::Directional, glm::vec3(3.0f), {}, -toSun));
    ball.addBall({0, 0, 0}, eye);
    Warnings notes;
    return pixelAt(viewer::renderPicture(ball.inputs(), phong(true), notes));
  };
  expectColor(middleOf({2, 0, 0}), glm::dvec3(3.0 / pi * toSun.z), 0.01);
  for (const double far : {0.4, 1.0, 3.0}) expectColor(middleOf(far * toSun), glm::dvec3(0.0), 0.01);
}

}  // namespace
}  // namespace prelight
