#include "export/prefiltered_sky.h"

#include <algorithm>
#include <cmath>

#include "basis/sh_projection.h"
#include "basis/sh_zonal.h"
#include "basis/sky_lobes.h"

namespace prelight {

namespace {

constexpr int smallestFace = 16, largestFace = 256;
int faceSizeFor(const Environment& sky) {
  int size = smallestFace;
  while (size < largestFace && 4 * size < sky.width) size *= 2;
  return size;
}

/// Looks a smooth map up between the centres of its texels.
glm::dvec3 lookUp(const Environment& map, const glm::dvec3& direction) {
  const glm::dvec2 at = Environment::coordinates(direction) * glm::dvec2(map.width, map.height) - 0.5;
  const double column = std::floor(at.x), row = std::floor(at.y);
  const auto texel = [&](double x, double y) {
    const int wrapped = (static_cast<int>(x) + map.width) % map.width;
    const int held = std::clamp(static_cast<int>(y), 0, map.height - 1);
    return glm::dvec3(map.radiance[static_cast<std::size_t>(held * map.width + wrapped)]);
  };
  const auto between = [&](double y) {
    return glm::mix(texel(column, y), texel(column + 1.0, y), at.x - column);
  };
  return glm::mix(between(row), between(row + 1.0), at.y - row);
}

CubeMap cubeOfLobe(const SkyLobes& lobes, double roughness, int faceSize) {
  const Environment map = lobes.map(roughness * roughness, std::max(4 * faceSize, 64));
  CubeMap level{faceSize, std::vector<glm::vec3>(cubeTexelCount(faceSize))};
  for (std::size_t i = 0; i < level.radiance.size(); ++i)
    level.radiance[i] = glm::vec3(lookUp(map, cubeTexelDirection(static_cast<std::uint32_t>(i), faceSize)));
  return level;
}

}  // namespace

double PrefilteredSky::roughness(std::size_t level) const {
  return levels.size() < 2 ? 0.0 : static_cast<double>(level) / static_cast<double>(levels.size() - 1);
}

PrefilteredSky prefilterSky(const Environment& sky) {
  constexpr int order = 3;
  PrefilteredSky result;
  std::vector<double> coefficients = sh::projectEnvironment(sky, order);
  sh::irradianceFromRadiance(coefficients, order);
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 9; ++i)
      result.irradiance[i][c] = coefficients[9 * static_cast<std::size_t>(c) + i];
  const int size = faceSizeFor(sky);
  result.levels.push_back(cubeFromEnvironment(sky, size));
  const SkyLobes lobes(sky);
  int count = 0;
  for (int face = size; face > smallestFace; face /= 2) ++count;
  for (int level = 1; level <= count; ++level)
    result.levels.push_back(cubeOfLobe(lobes, static_cast<double>(level) / count, size >> level));
  return result;
}

}  // namespace prelight
