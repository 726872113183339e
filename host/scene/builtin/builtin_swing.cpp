#include <cmath>
#include <numbers>

#include "scene/builtin/builtin_scenes.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight {

namespace {

constexpr const char* animationName = "swing";

glm::vec4 turn(const glm::vec3& axis, double degrees) {
  const double half = degrees * std::numbers::pi / 360.0;
  return {axis * static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

/// Returns a full turn in steps of a quarter, so that each step has an unambiguous shorter arc.
AnimationSampler fullTurn() {
  AnimationSampler sampler{Interpolation::Linear, {0, 1, 2, 3, 4}, {}};
  for (int quarter = 0; quarter <= 4; ++quarter)
    sampler.values.push_back(turn({0.0f, 1.0f, 0.0f}, 90.0 * quarter));
  return sampler;
}

/// Returns a swing: out, back through the middle, out on the other side and back. Tangents are those of a
/// sine in the angle.
AnimationSampler pendulum(double degrees) {
  AnimationSampler sampler{Interpolation::CubicSpline, {0, 1, 2, 3, 4}, {}};
  const double amplitude = degrees * std::numbers::pi / 180.0;
  for (int key = 0; key <= 4; ++key) {
    const double phase = key * std::numbers::pi / 2.0;
    const double half = 0.5 * amplitude * std::sin(phase);
    const double slope = 0.25 * std::numbers::pi * amplitude * std::cos(phase);
    const glm::vec4 tangent(0.0f, 0.0f, std::cos(half) * slope, -std::sin(half) * slope);
    sampler.values.insert(
        sampler.values.end(),
        {tangent, turn({0.0f, 0.0f, 1.0f}, 2.0 * half * 180.0 / std::numbers::pi), tangent});
  }
  return sampler;
}

/// Returns a board that hangs from the node's origin.
MeshShape makeBoard() {
  constexpr float length = 1.5f;
  MeshShape board = makeBox({0.12, length, 0.9}, 10, true);
  for (glm::vec3& position : board.positions) position.y -= length;
  return board;
}

}  // namespace

GltfDocument makeSwingScene() {
  GltfBuilder builder("swing");
  constexpr float lift = 0.01f;
  builder.addObject("Ground", makeGrid({-3.0, 0.0, 3.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, -6.0}, 36, 36),
                    builder.addDiffuse("Ground", {0.7f, 0.7f, 0.7f}));
  const int box = builder.addObject("Box", makeBox({1.2, 0.8, 0.6}, 8, true),
                                    builder.addDiffuse("Blue", {0.15f, 0.25f, 0.75f}), {1.5f, lift, 0.9f});
  const int ball = builder.addObject("Ball", makeSphere(0.45f, 24, 18),
                                     builder.addDiffuse("Red", {0.75f, 0.15f, 0.12f}), {-2.3f, lift, 1.2f});
  const int board = builder.addObject(
      "Board", makeBoard(), builder.addDiffuse("Yellow", {0.8f, 0.65f, 0.12f}), {-0.4f, 1.8f, -1.1f});
  builder.addObject("Lamp", makeGrid({-0.5, 3.5, -0.5}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1, 1),
                    builder.addEmitter("Lamp", {30.0f, 28.0f, 24.0f}));
  builder.animate(animationName, box, AnimatedPath::Rotation, fullTurn());
  builder.animate(animationName, ball, AnimatedPath::Translation,
                  {Interpolation::Linear, {0, 4}, {{-2.3f, lift, 1.2f, 0.0f}, {2.3f, lift, 2.1f, 0.0f}}});
  builder.animate(animationName, board, AnimatedPath::Rotation, pendulum(50.0));
  builder.addCamera("Camera", {0.0, 3.2, 6.2}, {0.0, 0.6, 0.0}, 0.65, 4.0 / 3.0);
  return builder.take();
}

}  // namespace prelight
