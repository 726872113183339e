// Light that objects hide and reflect, by their neighbourhoods, compared with closed forms.
#include "relight/neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh.h"
#include "occluders/occluder_record.h"
#include "relight/object_over_floor.h"
#include "support/devices.h"

namespace prelight {
namespace {

using test::ObjectOverFloor;
constexpr int order = 4;
constexpr std::size_t bands = order * order;
constexpr double evenSky = 3.5449077018110318;  // Square root of 4 pi.

/// Open transfer of vertices, as for a convex body or a floor.
HarmonicTransfer openOf(const CompiledScene& scene, const VertexRange& range) {
  HarmonicTransfer open{order, 1, 0, {}};
  std::vector<double> values(bands);
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    sh::openTransfer(glm::dvec3(scene.normals[v]), order, values);
    open.coefficients.insert(open.coefficients.end(), values.begin(), values.end());
  }
  return open;
}

struct Shadowed {
  ObjectOverFloor over;
  std::vector<float> direct;
  Tracer whole, walls;

  explicit Shadowed(const CompiledScene& object)
      : over(object),
        direct(openOf(over.scene, over.floor).coefficients),
        whole(over.scene, test::sharedDevice()),
        walls(whole, over.scene, trianglesOf(over.floor)) {}

  Neighbourhood neighbourhood() const {
    return {over.scene, over.object, openOf(over.scene, over.object), whole, order};
  }

  ObjectShadow by(const Neighbourhood& object) {
    return shadowByNeighbourhoods(over.scene, over.floor, std::span(&object, 1), direct, walls, order);
  }
};

/// Transfer that a ball takes from an open floor, by quadrature over the sphere.
std::vector<double> hiddenByBall(const glm::dvec3& way, double radius) {
  const double distance = glm::length(way), cosine = std::sqrt(1.0 - radius * radius / (distance * distance));
  std::vector<double> sum(bands, 0.0), values(bands);
  for (const SphereSample& sample : sphereQuadrature(199)) {
    if (sample.direction.y <= 0.0 || glm::dot(sample.direction, way) < cosine * distance) continue;
    sh::evaluate(sample.direction, order, values);
    for (std::size_t i = 0; i < bands; ++i)
      sum[i] += sample.direction.y / std::numbers::pi * sample.weight * values[i];
  }
  return sum;
}

TEST(Neighbourhood, BallOverAFloor_HidesItsCap) {
  const glm::dvec3 centre(0.1, 0.6, -0.2);
  constexpr double radius = 0.3;
  Shadowed ball(test::sphere(48, float(radius), glm::vec3(centre)));
  const ObjectShadow shadow = ball.by(ball.neighbourhood());
  double squares = 0.0, size = 0.0, offFactor = 0.0, factors = 0.0;
  for (std::uint32_t v = 0; v < ball.over.floor.vertexCount; ++v) {
    const glm::dvec3 way = centre - glm::dvec3(ball.over.scene.positions[v]);
    const double factor = ballFormFactor(glm::normalize(way).y, radius / glm::length(way));
    offFactor += std::pow(double(shadow.hidden[v]) - factor, 2.0);
    factors += factor * factor;
    const std::vector<double> exact = hiddenByBall(way, radius);
    for (std::size_t i = 0; i < bands; ++i) {
      squares += std::pow(double(shadow.sky[v * bands + i]) - exact[i], 2.0);
      size += exact[i] * exact[i];
    }
  }
  EXPECT_GT(factors, 1.0);
  EXPECT_LT(std::sqrt(offFactor / factors), 0.05);
  EXPECT_LT(std::sqrt(squares / size), 0.06);
  for (const float share : shadow.surfaces) EXPECT_LT(share, 0.02f);
}

/// A round plate without thickness that is seen from both sides.
CompiledScene disk(double radius, double height) {
  constexpr std::uint32_t segments = 64;
  std::vector<glm::vec3> positions{{0.0f, float(height), 0.0f}};
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t s = 0; s < segments; ++s) {
    const double turn = 2.0 * std::numbers::pi * s / segments;
    positions.emplace_back(radius * std::cos(turn), height, radius * std::sin(turn));
    triangles.emplace_back(0, 1 + s, 1 + (s + 1) % segments);
  }
  CompiledScene scene = test::sceneOf(std::move(positions), std::move(triangles));
  scene.materials[0].doubleSided = true;
  return scene;
}

// Straight below its middle a disk hides r^2 / (r^2 + h^2) of an even sky.
TEST(Neighbourhood, DiskAboveAPoint_HidesItsFormFactor) {
  constexpr double radius = 0.5;
  for (const double height : {0.4, 0.7, 1.2, 2.5}) {
    Shadowed plate(disk(radius, height));
    const ObjectShadow shadow = plate.by(plate.neighbourhood());
    std::uint32_t middle = 0;
    for (std::uint32_t v = 0; v < plate.over.floor.vertexCount; ++v)
      if (glm::length(plate.over.scene.positions[v]) < glm::length(plate.over.scene.positions[middle]))
        middle = v;
    const double exact = radius * radius / (radius * radius + height * height);
    EXPECT_NEAR(shadow.hidden[middle], exact, 0.02) << height;
    EXPECT_NEAR(evenSky * double(shadow.sky[middle * bands]), exact, 0.02) << height;
  }
}

// Under an even sky a convex body reflects its albedo times the light that it hides.
TEST(Neighbourhood, GreyBallUnderAnEvenSky_SendsItsAlbedoOfWhatItHides) {
  Shadowed ball(test::sphere(32, 0.3f, {0.0f, 0.5f, 0.0f}));
  ball.over.scene.materials[ball.over.scene.triangleMaterials[ball.over.object.firstTriangle]].albedo = {
      0.25f, 0.5f, 0.75f};
  const ObjectShadow shadow = ball.by(ball.neighbourhood());
  double most = 0.0;
  for (std::uint32_t v = 0; v < ball.over.floor.vertexCount; ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const double hidden = double(shadow.sky[v * bands]), sent = double(shadow.sent[(3 * v + c) * bands]);
      EXPECT_NEAR(sent, 0.25 * double(c + 1) * hidden, 1e-4 + 0.005 * hidden) << v;
      most = std::max(most, sent);
    }
  EXPECT_GT(most, 0.02);
}

// An object that is turned and moved has the same effect on a point that moves with it.
TEST(Neighbourhood, TurnedAndMoved_ChangesAsBefore) {
  const CompiledScene rest = test::box(2, {-0.4f, 0.3f, -0.1f}, {0.4f, 0.9f, 0.1f}, false);
  Shadowed box(rest);
  Neighbourhood object = box.neighbourhood();
  const glm::dvec3 point(0.3, 0.0, 0.5), normal = glm::normalize(glm::dvec3(-0.2, 1.0, -0.3));
  std::vector<double> direct(bands);
  sh::openTransfer(normal, order, direct);
  Neighbourhood::Change before, after;
  object.change(point, normal, direct, before);
  const glm::dmat4 moved = glm::rotate(glm::translate(glm::dmat4(1.0), {0.7, 0.2, -0.4}), 1.1,
                                       glm::normalize(glm::dvec3(0.3, 1.0, 0.2)));
  box.over.place(moved, rest);
  object.follow(box.over.scene);
  const sh::ShRotation turn(order, glm::dmat3(moved));
  turn.apply(std::span<const double>(direct), std::span<double>(direct));
  object.change(glm::dvec3(moved * glm::dvec4(point, 1.0)), glm::dmat3(moved) * normal, direct, after);
  turn.apply(std::span<const double>(before.hidden), std::span<double>(before.hidden));
  EXPECT_GT(before.factor, 0.05);
  EXPECT_NEAR(after.factor, before.factor, 1e-5);
  for (std::size_t i = 0; i < bands; ++i) EXPECT_NEAR(after.hidden[i], before.hidden[i], 1e-5) << i;
}

}  // namespace
}  // namespace prelight
