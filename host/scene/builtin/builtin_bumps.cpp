#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "scene/builtin/builtin_scenes.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight {

namespace {

constexpr int mapSize = 256;

/// A height field over the unit square, which repeats, in units of the square's side.
using Height = std::function<double(double u, double v)>;

/// Returns the normal map of a height field, by central differences; v runs down, green is up.
Image normalsOf(const std::string& name, const Height& height) {
  Image image{name, mapSize, mapSize, {}};
  constexpr double step = 0.5 / mapSize;
  for (int row = 0; row < mapSize; ++row)
    for (int column = 0; column < mapSize; ++column) {
      const double u = (column + 0.5) / mapSize, v = (row + 0.5) / mapSize;
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3(-(height(u + step, v) - height(u - step, v)),
                                    height(u, v + step) - height(u, v - step), 2.0 * step));
      for (int a = 0; a < 3; ++a)
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (normal[a] + 1.0))));
      image.rgba.push_back(255);
    }
  return image;
}

/// Round cobbles in rows that are shifted by half.
double cobbles(double u, double v) {
  constexpr double rows = 4.0, columns = 4.0;
  const double row = std::floor(v * rows);
  const double y = v * rows - row - 0.5;
  const double along = u * columns + 0.5 * std::fmod(row + rows, 2.0);
  const double x = along - std::floor(along) - 0.5;
  const double r2 = 4.6 * (x * x + y * y);
  return 0.09 * std::sqrt(std::max(0.0, 1.0 - r2));
}

/// Soft waves in both directions.
double waves(double u, double v) {
  constexpr double turn = 2.0 * std::numbers::pi;
  return 0.012 * (std::sin(turn * (3.0 * u + v)) + std::sin(turn * (5.0 * v - 2.0 * u)));
}

}  // namespace

GltfDocument makeBumpsScene() {
  GltfBuilder builder("bumps");
  const Image stones = normalsOf("Cobbles", cobbles), plaster = normalsOf("Plaster", waves);
  builder.addUnfolded("Ground", makeGrid({-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0}, 24, 24),
                      builder.addBumpy("Stone", {0.55f, 0.52f, 0.48f}, stones, 3.0f));
  builder.addUnfolded("Wall", makeGrid({-2.0, 0.0, -2.0}, {4.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, 24, 12),
                      builder.addBumpy("Plaster", {0.75f, 0.6f, 0.45f}, plaster, 2.0f));
  // The block reaches below the ground, as objects in scenes often do.
  builder.addUnfolded("Block", makeBox({1.1, 1.0, 0.8}, 8, true),
                      builder.addDiffuse("Blue", {0.2f, 0.3f, 0.7f}), {-0.5f, -0.1f, -0.5f}, 0.5);
  builder.addPointLight("Light", {2.5f, 3.0f, 2.0f}, {1.0f, 0.95f, 0.85f}, 30.0);
  builder.addCamera("Camera", {1.6, 2.2, 4.0}, {-0.1, 0.3, -0.4}, 0.75, 4.0 / 3.0);
  return builder.take();
}

}  // namespace prelight
