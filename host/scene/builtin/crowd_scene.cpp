#include "scene/builtin/crowd_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace prelight {
namespace {

constexpr double goldenAngle = std::numbers::pi * (3.0 - 2.23606797749979);

/// Returns one of five shapes, about 1.4 m wide.
MeshShape shapeOf(int kind) {
  switch (kind % 5) {
    case 0:
      return makeSphere(0.7f, 36, 26);
    case 1:
      return makeTorus(0.55f, 0.22f, 42, 22);
    case 2:
      return makeBox({1.1, 1.3, 0.9}, 11, true);
    case 3:
      return makeCone(0.6f, 1.7f, 40, 16, 6);
    default:
      return makeCylinder(0.45f, 1.5f, 40, 16, 6);
  }
}

/// Returns a colour of the colour circle; all have the same lightness.
glm::vec3 hue(double turn) {
  const auto channel = [&](double shift) {
    return static_cast<float>(0.42 + 0.36 * std::cos(2.0 * std::numbers::pi * (turn - shift)));
  };
  return {channel(0.0), channel(1.0 / 3.0), channel(2.0 / 3.0)};
}

}  // namespace

/// The place is that of a seed in a sunflower: evenly spaced, in no rows.
void addCrowdObject(int number, bool metal, GltfBuilder& builder) {
  constexpr double lift = 0.01;  // keeps faces out of the ground's plane
  constexpr double spacing = 1.35;
  const double radius = spacing * std::sqrt(number + 0.3), angle = goldenAngle * number;
  PlainMaterial material{.name = fmt::format("Colour {}", number),
                         .baseColor = glm::vec4(hue(0.381966 * number), 1.0f)};
  if (metal) {
    material.metallic = 1.0f;
    material.roughness = 0.3f;
  }
  builder.addObject(fmt::format("Object {}", number), shapeOf(number * 3 + number / 5),
                    builder.addPlain(material),
                    glm::vec3(radius * std::cos(angle), lift, radius * std::sin(angle)), 1.7 * number);
}

GltfDocument makeCrowdScene(int objects, int lights) {
  GltfBuilder builder("crowd");
  constexpr double half = 8.0;
  constexpr int metalEvery = 6;
  builder.addObject("Ground",
                    makeGrid({-half, 0.0, half}, {2 * half, 0.0, 0.0}, {0.0, 0.0, -2 * half}, 48, 48),
                    builder.addDiffuse("Ground", {0.7f, 0.7f, 0.7f}));
  for (int i = 0; i < objects; ++i) addCrowdObject(i, i % metalEvery == metalEvery - 1, builder);
  for (int i = 0; i < lights; ++i) {
    const double radius = 7.5 * std::sqrt((i + 0.5) / lights), angle = goldenAngle * i + 1.0;
    const glm::vec3 color = glm::mix(glm::vec3(1.0f), hue(i / static_cast<double>(lights)), 0.5f);
    builder.addPointLight(
        fmt::format("Light {}", i),
        glm::vec3(radius * std::cos(angle), 3.5 + 0.15 * ((7 * i) % 10), radius * std::sin(angle)), color,
        160.0 / lights);
  }
  builder.addCamera("Camera", {0.0, 7.6, 11.5}, {0.0, 0.2, 0.6}, 0.6, 16.0 / 9.0);
  return builder.take();
}

}  // namespace prelight
