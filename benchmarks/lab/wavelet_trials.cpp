#include "benchmarks/lab/wavelet_trials.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "basis/sh.h"
#include "techniques/haar/haar_relight.h"

namespace prelight {

CubeResampling rotateByPoint(const glm::dmat3& rotation, int faceSize) {
  checkCubeFaceSize(faceSize, "cube map");
  const glm::dmat3 inverse = glm::transpose(rotation);
  CubeResampling result{.faceSize = faceSize, .offsets = {0}, .sources = {}, .weights = {}};
  for (std::uint32_t texel = 0; texel < cubeTexelCount(faceSize); ++texel) {
    result.sources.push_back(cubeTexel(inverse * cubeTexelDirection(texel, faceSize), faceSize));
    result.weights.push_back(1.0f);
    result.offsets.push_back(texel + 1);
  }
  return result;
}

}  // namespace prelight

namespace prelight::haar {
namespace {

/// Returns the part of a light that SH of an order represents, at the centres of texels, [channel][texel].
std::vector<float> shPart(const CubeMap& light, int order) {
  const CubeTexels texels(light.faceSize);
  const std::size_t count = texels.count();
  const auto terms = static_cast<std::size_t>(sh::coefficientCount(order));
  std::vector<double> basis(terms);
  std::vector<glm::dvec3> coefficients(terms, glm::dvec3(0.0));
  for (std::uint32_t i = 0; i < count; ++i) {
    sh::evaluate(cubeTexelDirection(i, light.faceSize), order, basis);
    const glm::dvec3 flux = texels.solidAngle(i) * glm::dvec3(light.radiance[i]);
    for (std::size_t k = 0; k < terms; ++k) coefficients[k] += basis[k] * flux;
  }
  std::vector<float> part(3 * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    sh::evaluate(cubeTexelDirection(i, light.faceSize), order, basis);
    glm::dvec3 value(0.0);
    for (std::size_t k = 0; k < terms; ++k) value += basis[k] * coefficients[k];
    for (int c = 0; c < 3; ++c) part[static_cast<std::size_t>(c) * count + i] = static_cast<float>(value[c]);
  }
  return part;
}

}  // namespace

std::vector<float> areaWeights(int faceSize) {
  const CubeTexels texels(faceSize);
  // The supports of one size tile the face: solid angles are summed over blocks of quadrupling area, then
  // divided by the size.
  std::vector<double> sums(texels.count() / cubeFaces);
  for (std::uint32_t i = 0; i < sums.size(); ++i) sums[i] = texels.solidAngle(i);
  std::vector<float> face(sums.size());
  const auto size = static_cast<std::size_t>(faceSize);
  for (std::size_t half = 1; half < size; half *= 2) {
    for (std::size_t row = 0; row < size; row += 2 * half) {
      for (std::size_t column = 0; column < size; column += 2 * half) {
        const std::size_t p = row * size + column, q = p + half, s = p + half * size, t = s + half;
        sums[p] += sums[q] + sums[s] + sums[t];
        face[q] = face[s] = face[t] = static_cast<float>(sums[p] / (2.0 * static_cast<double>(half)));
      }
    }
  }
  face[0] = static_cast<float>(sums[0] / static_cast<double>(size));
  std::vector<float> weights;
  for (int f = 0; f < cubeFaces; ++f) weights.insert(weights.end(), face.begin(), face.end());
  return weights;
}

SparseLight selectLightSoftly(std::span<const float> light, std::span<const float> weights, std::size_t count,
                              float fade) {
  assert(fade > 1.0f);
  const std::vector<float> magnitudes = lightMagnitudes(light, weights);
  const SparseLight kept = selectLight(light, weights, count);
  std::vector<float> others = magnitudes;
  for (const std::uint32_t i : kept.indices) others[i] = 0.0f;
  const float limit = others.empty() ? 0.0f : *std::max_element(others.begin(), others.end());
  SparseLight selection;
  for (std::size_t k = 0; k < kept.indices.size(); ++k) {
    const float factor = std::min((1.0f - limit / magnitudes[kept.indices[k]]) * fade / (fade - 1.0f), 1.0f);
    if (factor <= 0.0f) continue;
    selection.indices.push_back(kept.indices[k]);
    selection.values.push_back(factor * kept.values[k]);
  }
  return selection;
}

HaarTransfer keepRows(const HaarTransfer& transfer, double relativeError) {
  HaarTransfer result{transfer.faceSize, transfer.channels, transfer.bounces, {0}, {}, {}};
  for (std::size_t row = 0; row + 1 < transfer.offsets.size(); ++row) {
    const std::size_t begin = transfer.offsets[row], size = transfer.offsets[row + 1] - begin;
    SparseRow kept = keepError(std::span(transfer.values).subspan(begin, size), relativeError);
    for (std::uint32_t& index : kept.indices) index = transfer.indices[begin + index];
    appendRow(result, kept);
  }
  return result;
}

BasisChoice chooseBasis(const CubeMap& light, int shOrder, std::size_t haarCount,
                        std::span<const float> weights) {
  const std::vector<float> coefficients = transformLight(light);
  std::vector<float> part = shPart(light, shOrder);
  const std::size_t count = weights.size();
  for (std::size_t c = 0; c < 3; ++c)
    forward(std::span<float>(part).subspan(c * count, count), light.faceSize);
  SparseLight smooth;
  for (std::uint32_t i = 0; i < count; ++i) {
    smooth.indices.push_back(i);
    smooth.values.push_back({part[i], part[count + i], part[2 * count + i]});
  }
  BasisChoice choice;
  choice.shError = expectedError(coefficients, smooth, weights);
  choice.haarError = expectedError(coefficients, selectLight(coefficients, weights, haarCount), weights);
  choice.haar = choice.haarError < choice.shError;
  return choice;
}

}  // namespace prelight::haar
