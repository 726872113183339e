#include "scene/builtin/surface_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace prelight {
namespace {

/// Returns the sRGB encoding of 4096 linear values in equal steps from 0 to 1.
std::array<std::uint8_t, 4096> encodingTable() {
  std::array<std::uint8_t, 4096> table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double linear = static_cast<double>(i) / (table.size() - 1);
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    table[i] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
  }
  return table;
}

std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(255.0f * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

Image blankImage(const std::string& name, int size) {
  Image image{name, size, size, {}};
  image.rgba.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4);
  return image;
}

/// Returns normals by central differences of the heights; green is up.
Image normalsOf(const std::string& name, int size, double side, const std::vector<SurfacePoint>& points) {
  Image image = blankImage(name, size);
  const auto step = static_cast<float>(2.0 * side / size);
  const auto height = [&](int column, int row) {
    const int c = (column + size) % size, r = (row + size) % size;
    return points[static_cast<std::size_t>(r * size + c)].height;
  };
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const glm::vec3 normal =
          glm::normalize(glm::vec3(height(column - 1, row) - height(column + 1, row),
                                   height(column, row + 1) - height(column, row - 1), step));
      for (int a = 0; a < 3; ++a) image.rgba.push_back(toByte(0.5f * (normal[a] + 1.0f)));
      image.rgba.push_back(255);
    }
  return image;
}

}  // namespace

SurfaceMaps makeSurfaceMaps(const std::string& name, int size, double side, const SurfacePattern& pattern) {
  static const std::array<std::uint8_t, 4096> encoding = encodingTable();
  std::vector<SurfacePoint> points;
  points.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  const float texel = 1.0f / static_cast<float>(size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      points.push_back(
          pattern((static_cast<float>(column) + 0.5f) * texel, (static_cast<float>(row) + 0.5f) * texel));
  SurfaceMaps maps{blankImage(name + " albedo", size), blankImage(name + " roughness", size),
                   normalsOf(name + " normals", size, side, points)};
  for (const SurfacePoint& point : points) {
    for (int a = 0; a < 3; ++a) {
      const float value = std::clamp(point.albedo[a], 0.0f, 1.0f);
      maps.albedo.rgba.push_back(encoding[static_cast<std::size_t>(4095.0f * value + 0.5f)]);
    }
    maps.albedo.rgba.push_back(255);
    const std::uint8_t roughness[] = {0, toByte(point.roughness), 255, 255};
    maps.roughness.rgba.insert(maps.roughness.rgba.end(), std::begin(roughness), std::end(roughness));
  }
  return maps;
}

float hashed(int x, int y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                    static_cast<std::uint32_t>(y) * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

float tiledNoise(float u, float v, int cellsU, int cellsV, std::uint32_t seed) {
  const float x = u * static_cast<float>(cellsU), y = v * static_cast<float>(cellsV);
  const float fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const auto wrapped = [](int i, int n) { return ((i % n) + n) % n; };
  const int x0 = wrapped(ix, cellsU), x1 = wrapped(ix + 1, cellsU);
  const int y0 = wrapped(iy, cellsV), y1 = wrapped(iy + 1, cellsV);
  const auto ease = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const float s = ease(x - fx), t = ease(y - fy);
  const float low = glm::mix(hashed(x0, y0, seed), hashed(x1, y0, seed), s);
  const float high = glm::mix(hashed(x0, y1, seed), hashed(x1, y1, seed), s);
  return glm::mix(low, high, t);
}

float tiledTurbulence(float u, float v, int cellsU, int cellsV, int octaves, std::uint32_t seed) {
  float sum = 0.0f, weight = 0.5f, total = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * tiledNoise(u, v, cellsU << i, cellsV << i, seed + static_cast<std::uint32_t>(i));
    total += weight;
    weight *= 0.5f;
  }
  return sum / total;
}

}  // namespace prelight
