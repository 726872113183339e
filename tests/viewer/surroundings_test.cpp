// Mirrors and glass in global illumination, compared with rays on the host in rooms of known radiance.
#include "viewer/cubes/surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>

#include "charts/make_light_map_layout.h"
#include "gi/global_illumination.h"
#include "support/scenes.h"
#include "viewer/drawn_passes.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

constexpr int size = 96;
constexpr double ballRadius = 0.6;
constexpr double roomHalf = 2.0;

/// Radiance of the walls of a room [-roomHalf, roomHalf]^3: -x, +x, -y, +y, -z, +z.
constexpr std::array<glm::vec3, 6> walls = {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1),
                                            glm::vec3(1, 1, 0), glm::vec3(0, 1, 1), glm::vec3(1, 0, 1)};

struct Ball {
  QuadScene quad;
  GlobalIllumination globalIllumination;
  Shading shading = Shading::GlobalIllumination;
  bool emitters = false;

  enum class Around : std::uint8_t { Nothing, Room, Floor, AnotherBall };

  /// A ball of `segments` x 2 `segments` quads at `center`, which the eye sees from inside the room.
  explicit Ball(const Material& material, const glm::vec3& center, Around around, int segments = 48,
                bool lampsBehind = false) {
    addBall(material, center, segments);
    if (around == Around::Room) addRoom();
    if (lampsBehind) addRoom(roomHalf + 0.02, 50.0f);
    if (around == Around::Floor) addFloor();
    if (around == Around::AnotherBall) addBall(material, center + glm::vec3(1.3f, 0, 0), segments);
    quad.lookFrom(eye(), {0, 0, 0});
    compile();
  }

  /// Compiles the scene, with black indirect light.
  void compile() {
    quad.compile();
    LightMapLayoutRequest request;
    request.texels = 500;
    globalIllumination.indirect.layout = makeLightMapLayout(quad.scene, quad.compiled, request);
    globalIllumination.indirect.values.assign(3 * globalIllumination.indirect.layout.texelCount(), 0.0f);
  }

  void addBall(const Material& material, const glm::vec3& center, int segments, double radius = ballRadius) {
    Primitive& ball = quad.add(material);
    const CompiledScene sphere = test::sphere(segments, static_cast<float>(radius), center);
    ball.positions = sphere.positions;
    ball.normals.clear();
    for (const glm::vec3& p : sphere.positions) ball.normals.push_back(glm::normalize(p - center));
    ball.triangles = sphere.triangles;
    ball.texCoords0.clear();
  }

  /// Adds a two-sided box whose top is at height 0.05.
  void addFloor() {
    Material black = lambertian(glm::vec3(0.0f));
    black.doubleSided = true;
    Primitive& floor = quad.add(black);
    const CompiledScene box = test::box(1, {-2, -2, -2}, {2, 0.05f, 2}, false);
    floor.positions = box.positions;
    floor.normals = box.normals;
    floor.triangles = box.triangles;
    floor.texCoords0.clear();
  }

  static glm::dvec3 eye() { return {0.3, 0.5, 1.9}; }

  void addRoom(double half = roomHalf, float strength = 1.0f) {
    for (int i = 0; i < 6; ++i) {
      Material wall = lambertian(glm::vec3(0.0f));
      wall.emission = strength * walls[static_cast<std::size_t>(i)];
      const int axis = i / 2;
      glm::dvec3 inward(0.0), x(0.0);
      inward[axis] = i % 2 == 0 ? 1.0 : -1.0;
      x[(axis + 1) % 3] = 1.0;
      const glm::dvec3 y = glm::cross(inward, x);
      quad.add(wall, static_cast<float>(half),
               glm::dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(inward, 0),
                          glm::dvec4(-half * inward, 1)));
    }
  }

  viewer::RenderInputs inputs() const {
    viewer::RenderInputs inputs = quad.inputs();
    inputs.globalIllumination = &globalIllumination;
    return inputs;
  }

  Picture render() const {
    viewer::RenderOptions options = square(shading, size);
    options.samplesPerAxis = 1;
    options.emitters = emitters;
    Warnings notes;
    return viewer::renderPicture(inputs(), options, notes);
  }

  /// World direction through a pixel's centre.
  glm::dvec3 way(int x, int y) const {
    const viewer::CameraMatrices camera = viewer::cameraMatrices(quad.scene.cameras[0], quad.compiled, 1.0);
    const glm::dvec4 far = glm::inverse(camera.projection * camera.view) *
                           glm::dvec4(2.0 * (x + 0.5) / size - 1.0, 1.0 - 2.0 * (y + 0.5) / size, 1.0, 1.0);
    return glm::normalize(glm::dvec3(far) / far.w - camera.position);
  }
};

/// The wall that a ray from inside the room hits, and in `margin` the distance of the hit from the wall's
/// edges, m.
glm::dvec3 wallSeen(const glm::dvec3& from, const glm::dvec3& way, double& margin) {
  double nearest = 1e30;
  std::size_t wall = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = ((way[axis] > 0.0 ? roomHalf : -roomHalf) - from[axis]) / way[axis];
    if (!(along < nearest)) continue;
    nearest = along;
    wall = static_cast<std::size_t>(2 * axis + (way[axis] > 0.0 ? 1 : 0));
  }
  const glm::dvec3 place = from + nearest * way;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != static_cast<int>(wall / 2)) margin = std::min(margin, roomHalf - std::abs(place[axis]));
  return walls[wall];
}

/// First intersection with the ball; negative if there is none.
double meetBall(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& center,
                double radius = ballRadius) {
  const glm::dvec3 o = from - center;
  const double b = glm::dot(o, way), c = glm::dot(o, o) - radius * radius, d = b * b - c;
  return d < 0.0 ? -1.0 : -b - std::sqrt(d);
}

Material mirror(float roughness = 0.0f) {
  Material material;
  material.baseColor = glm::vec4(1.0f);
  material.metallic = 1.0f;
  material.roughness = roughness;
  return material;
}

struct Comparison {
  int compared = 0, wrong = 0;
};

/// Compares the pixels on the ball whose rays stay at least `least` m off the edges of walls.
template <typename Expected>
Comparison compare(const Ball& ball, const glm::dvec3& center, double least, const Expected& expected) {
  const Picture picture = ball.render();
  Comparison result;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 way = ball.way(x, y);
      const double along = meetBall(Ball::eye(), way, center);
      if (along <= 0.0) continue;
      const glm::dvec3 point = Ball::eye() + along * way, n = (point - center) / ballRadius;
      if (glm::dot(n, -way) < 0.2) continue;  // The silhouette of the mesh.
      double margin = 1e30;
      const glm::dvec3 radiance = expected(point, n, way, margin);
      if (margin < least) continue;
      ++result.compared;
      const glm::dvec3 drawn(picture.pixels[static_cast<std::size_t>(y * size + x)]);
      if (glm::length(drawn - radiance) > 0.05) ++result.wrong;
    }
  return result;
}

TEST(Surroundings, MirrorBallUnderASky_ShowsTheSkyItself) {
  const Environment sky = halvedSky();
  Ball ball(mirror(), glm::vec3(0.0f), Ball::Around::Nothing);
  ball.quad.setSky(sky);
  const Comparison result =
      compare(ball, glm::dvec3(0.0), 0.1, [&](const auto&, const auto& n, const auto& way, double& margin) {
        const glm::dvec3 w = glm::reflect(way, n);
        margin = std::min(std::abs(w.x), std::abs(w.y));
        return glm::dvec3(w.x > 0.0 ? 1.0 : 0.0, w.x < 0.0 ? 1.0 : 0.0, w.y > 0.0 ? 1.0 : 0.0);
      });
  EXPECT_GT(result.compared, 500);
  EXPECT_EQ(result.wrong, 0);
}

/// The ball's centre lies inside the floor, from where everything is black.
TEST(Surroundings, MirrorBallSunkInATwoSidedFloor_ShowsTheSkyAboveIt) {
  const Environment sky = halvedSky();
  Ball ball(mirror(), glm::vec3(0.0f), Ball::Around::Floor);
  ball.quad.setSky(sky);
  const Comparison result = compare(ball, glm::dvec3(0.0), 0.15,
                                    [&](const auto& point, const auto& n, const auto& way, double& margin) {
                                      const glm::dvec3 w = glm::reflect(way, n);
                                      margin = point.y > 0.1 ? std::min(std::abs(w.x), w.y) : 0.0;
                                      return glm::dvec3(w.x > 0.0 ? 1.0 : 0.0, w.x < 0.0 ? 1.0 : 0.0, 1.0);
                                    });
  EXPECT_GT(result.compared, 200);
  EXPECT_LE(result.wrong, 0.01 * result.compared);
}

/// Lossless balls under an even sky look like the sky, even where they show one another.
TEST(Surroundings, RoughBallsThatShowOneAnother_HaveNoBlackBlots) {
  Ball balls(mirror(0.3f), glm::vec3(0.0f), Ball::Around::AnotherBall);
  balls.quad.setSky(constantEnvironment(glm::vec3(1.0f)));
  const Picture picture = balls.render();
  float least = 1e9f;
  for (const glm::vec3& pixel : picture.pixels) least = std::min(least, pixel.y);
  EXPECT_GT(least, 0.9f);
}

/// Expects that a mirror in the room shows its walls.
void expectTheWalls(const Ball& ball, const glm::dvec3& center) {
  const Comparison result =
      compare(ball, center, 0.12, [&](const auto& point, const auto& n, const auto& way, double& margin) {
        return wallSeen(point, glm::reflect(way, n), margin);
      });
  EXPECT_GT(result.compared, 500);
  EXPECT_LE(result.wrong, 0.005 * result.compared);
}

TEST(Surroundings, MirrorBallInARoom_ShowsWhatRaysMeet) {
  const glm::dvec3 center(-0.4, 0.2, -0.3);
  const Ball ball(mirror(), glm::vec3(center), Ball::Around::Room);
  expectTheWalls(ball, center);
}

/// Depth must separate surfaces that lie close behind one another.
TEST(Surroundings, LampsCloseBehindTheWalls_AreHidden) {
  const glm::dvec3 center(-0.4, 0.2, -0.3);
  const Ball ball(mirror(), glm::vec3(center), Ball::Around::Room, 48, true);
  expectTheWalls(ball, center);
}

TEST(LocalReflections, MirrorBallInARoom_ShowsWhatRaysMeet) {
  const glm::dvec3 center(-0.4, 0.2, -0.3);
  Ball ball(mirror(), glm::vec3(center), Ball::Around::Room);
  ball.quad.bakeOpen(3);
  ball.shading = Shading::Sh;
  expectTheWalls(ball, center);
}

/// Lossless balls under an even sky look like the sky.
TEST(LocalReflections, RoughBallsThatShowOneAnother_LookLikeTheSky) {
  for (const float roughness : {0.1f, 0.4f, 0.8f}) {
    Ball balls(mirror(roughness), glm::vec3(0.0f), Ball::Around::AnotherBall);
    balls.quad.setSky(constantEnvironment(glm::vec3(1.0f)));
    balls.quad.bakeOpen(3);
    balls.shading = Shading::Sh;
    const Picture picture = balls.render();
    for (const glm::vec3& pixel : picture.pixels) ASSERT_NEAR(pixel.y, 1.0f, 0.03f) << roughness;
  }
}

/// Walls are emissive surfaces with samples, whose highlights would add to their reflections.
TEST(LocalReflections, EmissiveSurfaces_AreReflectedOnce) {
  Ball ball(mirror(0.3f), glm::vec3(0.0f), Ball::Around::Room);
  ball.quad.bakeOpen(3);
  ball.shading = Shading::Sh;
  const Picture without = ball.render();
  ball.emitters = true;
  EXPECT_LT(largestDifference(ball.render(), without), 1e-5);
}

/// A lamp behind a wall of the cube map makes no highlight, one before it does.
TEST(LocalReflections, LampBehindAWall_HasNoHighlight) {
  Ball ball(mirror(0.3f), glm::vec3(0.0f), Ball::Around::Room);
  ball.quad.bakeOpen(3);
  ball.shading = Shading::Sh;
  const Picture dark = ball.render();
  viewer::RenderOptions options = square(Shading::Sh, size);
  options.samplesPerAxis = 1;
  options.emitters = false;
  for (const bool behind : {false, true}) {
    const glm::dvec3 place(0.2, 0.4, behind ? 2.5 : 1.7);
    options.lights = std::vector<Light>{makeLight(LightType::Point, glm::vec3(10.0f), place)};
    const double difference = largestDifference(ball.quad.render(options), dark);
    EXPECT_EQ(difference > 1e-5, !behind) << difference;
  }
}

TEST(LocalReflections, BallAloneUnderASky_HasNoMapAndThePlanSaysWhy) {
  for (const auto around : {Ball::Around::Nothing, Ball::Around::Room}) {
    Ball ball(mirror(), glm::vec3(0.0f), around);
    ball.quad.setSky(constantEnvironment(glm::vec3(1.0f)));
    ball.quad.bakeOpen(3);
    const viewer::RenderInputs inputs = ball.inputs();
    const viewer::View view = viewer::makeView(inputs, squareByBake(Shading::Sh, 32));
    const viewer::gl::EglContext context;
    viewer::Renderer renderer(inputs);
    const std::vector<PlannedPass> plan = renderer.plan(view);
    ASSERT_EQ(plan.size(), 1u);
    EXPECT_EQ(plan[0].runs, around == Ball::Around::Room);
    EXPECT_EQ(plan[0].reason, plan[0].runs ? "1 nodes reflect what lies around them"
                                           : "little but the sky lies around what reflects");
  }
}

/// Nodes that reflect nothing but the sky take no map from a smaller one in a room.
TEST(LocalReflections, ManyLargeNodesUnderASky_TakeNoMaps) {
  Ball ball(mirror(), glm::vec3(0.0f), Ball::Around::Room);
  for (int i = 1; i <= viewer::Surroundings::mostNodes; ++i)
    ball.quad.add(mirror(), 3.0f, glm::translate(glm::dmat4(1.0), glm::dvec3(100.0 * i, 0, 0)));
  ball.quad.setSky(constantEnvironment(glm::vec3(1.0f)));
  ball.compile();
  ball.quad.bakeOpen(3);
  const viewer::RenderInputs inputs = ball.quad.inputs();
  const viewer::View view = viewer::makeView(inputs, squareByBake(Shading::Sh, 32));
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  const std::vector<PlannedPass> plan = renderer.plan(view);
  ASSERT_EQ(plan.size(), 1u);
  EXPECT_EQ(plan[0].reason, "1 nodes reflect what lies around them");
}

/// A window spreads the faces over pictures, and light changes while a cube is half drawn.
TEST(LocalReflections, LightThatChangedBetweenFaces_IsInAllLobesAtLast) {
  Ball ball(mirror(0.3f), glm::vec3(0.0f), Ball::Around::Nothing);
  Primitive& room = ball.quad.add(lambertian(glm::vec3(0.5f)));
  const CompiledScene box = test::box(4, glm::vec3(-2.0f), glm::vec3(2.0f), true);
  room.positions = box.positions;
  room.normals = box.normals;
  room.triangles = box.triangles;
  room.texCoords0.clear();
  ball.compile();
  ball.quad.bakeOpen(3);
  const viewer::RenderInputs inputs = ball.quad.inputs();
  const auto viewAt = [&](float strength) {
    viewer::RenderOptions options = square(Shading::Sh, size);
    options.samplesPerAxis = 1;
    options.emitters = false;
    options.lights = std::vector<Light>{makeLight(LightType::Point, glm::vec3(strength), {0.2, 0.4, 1.7})};
    return viewer::makeView(inputs, options);
  };
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs), fresh(inputs);
  viewer::renderView(renderer, viewAt(0.0f), 1);
  renderer.paceUpdates(true);
  viewer::renderView(renderer, viewAt(50.0f), 1);
  const viewer::View last = viewAt(10.0f);
  do viewer::renderView(renderer, last, 1);
  while (renderer.isBehind());
  EXPECT_LT(largestDifference(viewer::renderView(renderer, last, 1), viewer::renderView(fresh, last, 1)),
            1e-5);
}

TEST(LocalReflections, DiffuseScene_HasNoMapsAndNoRowInThePlan) {
  Ball ball(lambertian(glm::vec3(0.5f)), glm::vec3(0.0f), Ball::Around::Room);
  ball.quad.bakeOpen(3);
  const viewer::RenderInputs inputs = ball.inputs();
  const viewer::View view = viewer::makeView(inputs, squareByBake(Shading::Sh, 32));
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  EXPECT_TRUE(renderer.plan(view).empty());
}

TEST(Surroundings, GlassBallInARoom_ReflectsAndRefractsTwice) {
  const glm::dvec3 center(-0.4, 0.2, -0.3);
  Material glass;
  glass.baseColor = glm::vec4(1.0f);
  glass.metallic = 0.0f;
  glass.roughness = 0.0f;
  glass.transmission = 1.0f;
  glass.thickness = 1.0f;
  glass.ior = 1.5f;
  const Ball ball(glass, glm::vec3(center), Ball::Around::Room);
  const Comparison result =
      compare(ball, center, 0.15, [&](const auto& point, const auto& n, const auto& way, double& margin) {
        const double cosine = glm::dot(n, -way);
        const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / 2.25);
        const double s = (cosine - 1.5 * inside) / (cosine + 1.5 * inside),
                     p = (1.5 * cosine - inside) / (1.5 * cosine + inside), reflected = 0.5 * (s * s + p * p);
        const glm::dvec3 within = glm::refract(way, n, 1.0 / 1.5);
        const glm::dvec3 leaves = point - 2.0 * glm::dot(point - center, within) * within;
        const glm::dvec3 out = glm::refract(within, -(leaves - center) / ballRadius, 1.5);
        const glm::dvec3 mirrored = wallSeen(point, glm::reflect(way, n), margin);
        return reflected * mirrored + (1.0 - reflected) * wallSeen(leaves, out, margin);
      });
  EXPECT_GT(result.compared, 300);
  EXPECT_LE(result.wrong, 0.01 * result.compared);
}

TEST(Surroundings, StillScene_DrawsThemOnceAndAfterSlowChangesAFaceAtATime) {
  const Ball ball(mirror(), glm::vec3(0.0f), Ball::Around::Room);
  const viewer::RenderInputs inputs = ball.inputs();
  viewer::RenderOptions options = square(Shading::GlobalIllumination, 32);
  options.samplesPerAxis = 1;
  const viewer::View view = viewer::makeView(inputs, options);
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.faces(), 6u);
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.faces(), 0u);
  renderer.update(Shading::GlobalIllumination, {.indirect = ball.globalIllumination.indirect.values});
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.faces(), 1u);
  renderer.sceneMoved();
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.faces(), 6u);
  EXPECT_TRUE(renderer.plan(view)[1].runs);
}

/// Returns the colour of the pixel in which a picture shows a place.
glm::vec3 shownAt(const Ball& scene, const Picture& picture, const glm::dvec3& place) {
  const viewer::CameraMatrices camera =
      viewer::cameraMatrices(scene.quad.scene.cameras[0], scene.quad.compiled, 1.0);
  const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(place, 1.0);
  const auto pixel = [](double c) { return static_cast<std::size_t>(0.5 * size * (1.0 + c)); };
  return glm::vec3(picture.pixels[size * pixel(-clip.y / clip.w) + pixel(clip.x / clip.w)]);
}

/// A room with as many mirrors below as have maps.
Ball roomOfMaps() {
  Ball room(mirror(), glm::vec3(0, -1.2f, 0), Ball::Around::Room);
  for (int i = 1; i < viewer::Surroundings::mostNodes; ++i)
    room.quad.add(mirror(), 0.3f, glm::translate(glm::dmat4(1.0), glm::dvec3(0.05 * i, -1.5, 0.5)));
  return room;
}

TEST(Surroundings, MoreMirrorsThanMaps_ShowWhatTheNearestSeesAndANoteSaysSo) {
  Ball room = roomOfMaps();
  for (const double x : {-0.3, 0.3})
    room.quad.add(mirror(), 0.1f, glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.3, 0)));
  room.compile();
  Warnings notes;
  const Picture picture = viewer::renderPicture(room.inputs(), square(room.shading, size), notes);
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
    return note.starts_with("2 of the nodes that mirror or are glass are small and show what the nearest");
  }));
  // They face the eye and the wall behind it.
  for (const double x : {-0.3, 0.3})
    EXPECT_LT(glm::distance(shownAt(room, picture, {x, 0.3, 0.0}), walls[5]), 0.05f) << x;
}

TEST(Surroundings, SmallMirrorBallWithoutAMap_ShowsTheRoomOnAllSides) {
  Ball room = roomOfMaps();
  const glm::vec3 center(0.2f, 0.4f, 0.6f);
  constexpr double radius = 0.15;
  room.addBall(mirror(), center, 48, radius);
  room.compile();
  const Picture picture = room.render();
  int compared = 0, right = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 way = room.way(x, y);
      const double along = meetBall(Ball::eye(), way, center, radius);
      if (along <= 0.0) continue;
      const glm::dvec3 point = Ball::eye() + along * way, n = (point - glm::dvec3(center)) / radius;
      const glm::dvec3 mirrored = glm::reflect(way, n);
      double margin = 1e30;
      const glm::dvec3 wall = wallSeen(point, mirrored, margin);
      if (glm::dot(n, -way) < 0.3 || margin < 0.3 || mirrored.y < 0.0) continue;  // other mirrors lie below
      ++compared;
      const glm::dvec3 drawn(picture.pixels[static_cast<std::size_t>(y * size + x)]);
      right += glm::distance(drawn, wall) < 0.05 ? 1 : 0;
    }
  EXPECT_GT(compared, 50);
  EXPECT_GE(right, 0.95 * compared);
}

TEST(Surroundings, SmallGlassWithoutAMap_IsSeenThrough) {
  Ball room = roomOfMaps();
  Material glass;
  glass.metallic = glass.roughness = 0.0f;
  glass.transmission = 1.0f;
  glass.thickness = 0.1f;
  const glm::dvec3 place(0.0, 0.3, 0.0);
  room.quad.add(glass, 0.1f, glm::translate(glm::dmat4(1.0), place));
  room.compile();
  double margin = 1e30;
  const glm::vec3 behind(wallSeen(place, glm::normalize(place - Ball::eye()), margin));
  EXPECT_LT(glm::distance(shownAt(room, room.render(), place), behind), 0.15f);
}

}  // namespace
}  // namespace prelight
