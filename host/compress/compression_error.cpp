#include "compress/compression_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "basis/sh.h"
#include "prelight/error.h"

namespace prelight {

namespace {

void addLight(std::vector<std::vector<double>>& lights, std::span<const double> coefficients,
              const glm::dvec3& color) {
  std::vector<double> light;
  for (int c = 0; c < 3; ++c)
    for (const double value : coefficients) light.push_back(value * color[c]);
  lights.push_back(std::move(light));
}

}  // namespace

std::vector<std::vector<double>> testLights(int order) {
  std::vector<std::vector<double>> lights;
  std::vector<double> values(static_cast<std::size_t>(order * order), 0.0);
  values[0] = std::sqrt(4.0 * 3.14159265358979323846);  // radiance 1 from everywhere
  addLight(lights, values, {1.0, 1.0, 1.0});
  sh::openTransfer({0.0, 1.0, 0.0}, order, values);  // a lobe max(cos, 0) / pi about the zenith
  addLight(lights, values, {0.6, 0.8, 1.0});
  sh::evaluate(glm::normalize(glm::dvec3(0.3, 0.8, 0.5)), order, values);
  addLight(lights, values, {1.0, 0.9, 0.7});
  sh::evaluate(glm::normalize(glm::dvec3(-0.7, 0.4, -0.2)), order, values);
  addLight(lights, values, {0.3, 0.5, 1.0});
  return lights;
}

std::vector<glm::dvec3> relight(const HarmonicTransfer& transfer, std::span<const double> light) {
  const std::size_t n = light.size() / 3, channels = static_cast<std::size_t>(transfer.channels);
  assert(n == static_cast<std::size_t>(transfer.order * transfer.order));
  std::vector<glm::dvec3> out(transfer.coefficients.size() / (channels * n), glm::dvec3(0.0));
  for (std::size_t v = 0; v < out.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const float* row = transfer.coefficients.data() + (v * channels + (channels == 1 ? 0 : c)) * n;
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += light[c * n + i] * double(row[i]);
      out[v][static_cast<int>(c)] = sum;
    }
  return out;
}

CompressionError compressionError(const HarmonicTransfer& original, const HarmonicTransfer& restored,
                                  std::span<const double> vertexWeights) {
  if (original.order != restored.order || original.channels != restored.channels ||
      original.coefficients.size() != restored.coefficients.size())
    throw UsageError("compression error", "the two transfers differ in order, channels or vertices");
  const auto d = static_cast<std::size_t>(original.channels * original.order * original.order);
  const auto weight = [&](std::size_t v) { return vertexWeights.empty() ? 1.0 : vertexWeights[v]; };
  CompressionError error;
  double total = 0.0;
  for (std::size_t at = 0; at < original.coefficients.size(); ++at) {
    const double value = original.coefficients[at], difference = double(restored.coefficients[at]) - value;
    error.squared += weight(at / d) * difference * difference;
    total += weight(at / d) * value * value;
  }
  const auto relative = [](double squares, double of) { return of > 0.0 ? std::sqrt(squares / of) : 0.0; };
  error.vectorRms = relative(error.squared, total);
  double meanSquare = 0.0;
  const auto lights = testLights(original.order);
  for (const auto& light : lights) {
    const auto right = relight(original, light), got = relight(restored, light);
    double squares = 0.0, of = 0.0;
    for (std::size_t v = 0; v < right.size(); ++v) {
      const glm::dvec3 difference = got[v] - right[v];
      squares += weight(v) * glm::dot(difference, difference);
      of += weight(v) * glm::dot(right[v], right[v]);
    }
    const double rms = relative(squares, of);
    meanSquare += rms * rms / static_cast<double>(lights.size());
    error.worstLightingRms = std::max(error.worstLightingRms, rms);
  }
  error.lightingRms = std::sqrt(meanSquare);
  return error;
}

}  // namespace prelight
