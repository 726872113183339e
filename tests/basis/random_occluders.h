#pragma once

#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "basis/haar.h"
#include "techniques/haar/haar_relight.h"

namespace prelight {

/// Texel transfer of a receiver behind random caps: 0 where a cap covers the texel's centre.
inline std::vector<float> occludedTexels(const CubeTexels& texels, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto direction = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return glm::normalize(glm::dvec3(x, y, z));
  };
  std::vector<float> values(texels.count());
  texels.open(direction(), std::span<float>(values));
  const int caps = 1 + static_cast<int>(uniform(random) * 6.0);
  for (int cap = 0; cap < caps; ++cap) {
    const glm::dvec3 centre = direction();
    const double cosine = std::cos(0.1 + 0.7 * uniform(random));
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      if (glm::dot(cubeTexelDirection(i, texels.faceSize()), centre) > cosine) values[i] = 0.0f;
    }
  }
  return values;
}

/// Transfer of receivers behind random caps, by texel and in Haar coefficients.
struct OccludedReceivers {
  std::vector<std::vector<float>> texels;
  HaarTransfer transfer;

  OccludedReceivers(int faceSize, int count, unsigned seed, double relativeError = 0.0) {
    const CubeTexels cube(faceSize);
    std::mt19937 random(seed);
    transfer.faceSize = faceSize;
    transfer.offsets = {0};
    for (int r = 0; r < count; ++r) {
      texels.push_back(occludedTexels(cube, random));
      std::vector<float> row = texels.back();
      haar::forward(std::span<float>(row), faceSize);
      haar::appendRow(transfer, haar::keepError(row, relativeError));
    }
  }
};

/// Square root of the sum of squared distances divided by the sum of squared lengths.
inline double relativeRms(const std::vector<glm::dvec3>& values, const std::vector<glm::dvec3>& expected) {
  double error = 0.0, total = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    error += glm::dot(values[v] - expected[v], values[v] - expected[v]);
    total += glm::dot(expected[v], expected[v]);
  }
  return std::sqrt(error / total);
}

/// A sky that is brighter towards the zenith.
inline CubeMap gradientSky(int faceSize) {
  CubeMap sky{faceSize, std::vector<glm::vec3>(cubeTexelCount(faceSize))};
  for (std::uint32_t i = 0; i < sky.radiance.size(); ++i) {
    const auto up = static_cast<float>(cubeTexelDirection(i, faceSize).y);
    sky.radiance[i] = glm::vec3(0.4f + 0.3f * up, 0.5f + 0.4f * up, 0.7f + 0.3f * up);
  }
  return sky;
}

}  // namespace prelight
