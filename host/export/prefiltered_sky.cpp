#include "export/prefiltered_sky.h"

#include <cmath>

#include "base/parallel.h"
#include "basis/sh_projection.h"
#include "basis/sh_zonal.h"

namespace prelight {

namespace {

constexpr int smallestFace = 16, largestFace = 256;
/// Face size of the map that rough lobes are summed over. Its texels of 1.4 degrees are well below the width
/// of all lobes but the first.
constexpr int gatheredFace = 64;

int faceSizeFor(const Environment& sky) {
  int size = smallestFace;
  while (size < largestFace && 4 * size < sky.width) size *= 2;
  return size;
}

/// Texels of a cube with direction, solid angle and radiance.
struct GatheredTexels {
  std::vector<glm::vec3> directions, radiance;
  std::vector<float> solidAngles;

  explicit GatheredTexels(const CubeMap& map) : radiance(map.radiance) {
    const CubeTexels texels(map.faceSize);
    for (std::uint32_t i = 0; i < texels.count(); ++i) {
      directions.emplace_back(cubeTexelDirection(i, map.faceSize));
      solidAngles.push_back(static_cast<float>(texels.solidAngle(i)));
    }
  }
};

/// Returns the weighted mean over a lobe. With the half vector h of n and l, (n.h)^2 is (1 + n.l) / 2.
glm::vec3 meanOverLobe(const GatheredTexels& texels, const glm::vec3& normal, float alphaSquared) {
  glm::vec3 sum(0.0f);
  float weights = 0.0f;
  for (std::size_t i = 0; i < texels.directions.size(); ++i) {
    const float cosine = glm::dot(normal, texels.directions[i]);
    if (cosine <= 0.0f) continue;
    const float base = (alphaSquared - 1.0f) * (0.5f + 0.5f * cosine) + 1.0f;
    const float weight = cosine * texels.solidAngles[i] / (base * base);
    sum += weight * texels.radiance[i];
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

double PrefilteredSky::roughness(std::size_t level) const {
  return levels.size() < 2 ? 0.0 : static_cast<double>(level) / static_cast<double>(levels.size() - 1);
}

CubeMap prefilterCube(const CubeMap& map, double roughness, int faceSize) {
  const GatheredTexels texels(map);
  const auto alphaSquared = static_cast<float>(std::pow(roughness, 4.0));
  CubeMap level{faceSize, std::vector<glm::vec3>(cubeTexelCount(faceSize))};
  parallelRanges(level.radiance.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3 normal(cubeTexelDirection(static_cast<std::uint32_t>(i), faceSize));
      level.radiance[i] = meanOverLobe(texels, normal, alphaSquared);
    }
  });
  return level;
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
  const CubeMap gathered = cubeFromEnvironment(sky, gatheredFace);
  int count = 0;
  for (int face = size; face > smallestFace; face /= 2) ++count;
  for (int level = 1; level <= count; ++level)
    result.levels.push_back(prefilterCube(gathered, static_cast<double>(level) / count, size >> level));
  return result;
}

}  // namespace prelight
