#include "support/parted_rooms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {

namespace {

/// Half length of a wall. It is longer than the box, so that walls pass through those of the box.
constexpr double wallReach = 3.2;

/// The box [lower, upper], turned about the vertical through (middle, 0, 0).
CompiledScene turnedBox(const glm::vec3& lower, const glm::vec3& upper, double turn, double middle) {
  CompiledScene wall = box(2, lower, upper, false);
  const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
  const auto about = [&](const glm::vec3& v) {
    return glm::vec3(c * v.x + s * v.z, v.y, -s * v.x + c * v.z);
  };
  for (glm::vec3& p : wall.positions) p = about(p) + glm::vec3(static_cast<float>(middle), 0.0f, 0.0f);
  for (glm::vec3& n : wall.normals) n = about(n);
  return wall;
}

CompiledScene turnedSheet(double height, double turn, double middle) {
  const glm::vec3 along(static_cast<float>(wallReach * std::sin(turn)), 0.0f,
                        static_cast<float>(wallReach * std::cos(turn)));
  const glm::vec3 low(static_cast<float>(middle), 0.0f, 0.0f), high(low.x, static_cast<float>(height), 0.0f);
  CompiledScene sheet =
      sceneOf({low - along, low + along, high + along, high - along}, {{0, 1, 2}, {0, 2, 3}}, 0.5f);
  sheet.materials[0].doubleSided = true;
  return sheet;
}

}  // namespace

Light PartedRooms::lamp() const {
  Light light;
  light.position = glm::dvec3(0.0, 0.9, 0.1) - 1.1 * normal;
  light.intensity = glm::vec3(4.0f, 3.0f, 2.0f);
  return light;
}

void PartedRooms::forDarkPlaces(
    const std::function<void(std::uint32_t, double, double, const glm::dvec3&)>& visit) const {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int placesOfTriangle = 400;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::dvec3 a(scene.positions[scene.triangles[t].x]), b(scene.positions[scene.triangles[t].y]),
        c(scene.positions[scene.triangles[t].z]);
    const double da = glm::dot(normal, a) - beyond, db = glm::dot(normal, b) - beyond,
                 dc = glm::dot(normal, c) - beyond;
    if (std::max({da, db, dc}) <= 0.0) continue;
    for (int i = 0; i < placesOfTriangle; ++i) {
      const double root = std::sqrt(uniform(random)), v = uniform(random);
      double b1 = root * (1.0 - v), b2 = root * v;
      glm::dvec3 p = (1.0 - b1 - b2) * a + b1 * b + b2 * c;
      double d = glm::dot(normal, p) - beyond;
      // Three of four places move towards the wall, on the way to a point on its other side.
      if (i % 4 != 0 && std::min({da, db, dc}) < 0.0 && d > 0.0) {
        const int lit = da <= db && da <= dc ? 0 : db <= dc ? 1 : 2;
        const double low = lit == 0 ? da : lit == 1 ? db : dc;
        const double share = d / (d - low) * (1.0 - std::pow(10.0, -1.0 - 4.0 * uniform(random)));
        b1 += share * ((lit == 1 ? 1.0 : 0.0) - b1);
        b2 += share * ((lit == 2 ? 1.0 : 0.0) - b2);
        p = (1.0 - b1 - b2) * a + b1 * b + b2 * c;
        d = glm::dot(normal, p) - beyond;
      }
      constexpr double rounding = 1e-5;
      if (d > rounding) visit(t, b1, b2, p);
    }
  }
}

PartedRooms partedRooms(double thickness, double turn, double shift, int cells) {
  PartedRooms rooms;
  rooms.scene = box(cells, {-2.0f, 0.0f, -2.0f}, {2.0f, 2.0f, 2.0f}, true);
  rooms.normal = {std::cos(turn), 0.0, -std::sin(turn)};
  rooms.beyond = glm::dot(rooms.normal, glm::dvec3(shift, 0.0, 0.0)) + 0.5 * thickness;
  const auto half = static_cast<float>(0.5 * thickness), reach = static_cast<float>(wallReach);
  append(rooms.scene, thickness > 0.0 ? turnedBox({-half, 0.0f, -reach}, {half, 2.0f, reach}, turn, shift)
                                      : turnedSheet(2.0, turn, shift));
  for (CompiledMaterial& material : rooms.scene.materials) {
    const bool doubleSided = material.doubleSided;
    material = lambert(0.7f);
    material.doubleSided = doubleSided;
  }
  return rooms;
}

PartedRooms partedStoreys(double thickness) {
  PartedRooms rooms;
  rooms.scene = box(4, {-2.0f, -2.0f, -2.0f}, {2.0f, 2.0f, 2.0f}, true);
  rooms.normal = {0.0, 1.0, 0.0};
  rooms.beyond = 0.5 * thickness;
  const auto half = static_cast<float>(0.5 * thickness);
  append(rooms.scene, box(2, {-2.5f, -half, -2.5f}, {2.5f, half, 2.5f}, false));
  for (CompiledMaterial& material : rooms.scene.materials) material = lambert(0.7f);
  return rooms;
}

}  // namespace prelight::test
