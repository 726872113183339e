#include "prelight/relight.h"

#include <fmt/format.h>

#include <numbers>

#include "base/parallel.h"
#include "basis/cube_map.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::size_t vertexGrain = 4096;

void requireLight(std::size_t got, std::size_t expected) {
  if (got != expected)
    throw UsageError("light", fmt::format("got {} coefficients, expected {}, three channels of {}", got,
                                          expected, expected / 3));
}

}  // namespace

std::vector<glm::vec3> irradiance(const HarmonicTransfer& transfer, std::span<const double> light,
                                  int lightOrder) {
  const auto lightTerms = static_cast<std::size_t>(lightOrder * lightOrder);
  if (lightOrder < transfer.order)
    throw UsageError("light",
                     fmt::format("it has order {}, the transfer order {}", lightOrder, transfer.order),
                     "project the light to that order");
  requireLight(light.size(), 3 * lightTerms);
  const auto terms = static_cast<std::size_t>(transfer.order * transfer.order);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  std::vector<glm::vec3> factors(terms);  // all channels together, so that a vertex is read once
  for (std::size_t i = 0; i < terms; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      factors[i][static_cast<int>(c)] = static_cast<float>(std::numbers::pi * light[c * lightTerms + i]);
  std::vector<glm::vec3> lit(transfer.coefficients.size() / (channels * terms));
  parallelRanges(lit.size(), vertexGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const float* row = transfer.coefficients.data() + v * channels * terms;
      glm::vec3 sum(0.0f);
      if (channels == 1)
        for (std::size_t i = 0; i < terms; ++i) sum += row[i] * factors[i];
      else
        for (std::size_t i = 0; i < terms; ++i)
          sum += glm::vec3(row[i], row[terms + i], row[2 * terms + i]) * factors[i];
      lit[v] = sum;
    }
  });
  return lit;
}

std::vector<glm::vec3> irradiance(const HaarTransfer& transfer, std::span<const float> light) {
  const std::size_t texels = cubeTexelCount(transfer.faceSize);
  requireLight(light.size(), 3 * texels);
  const auto channels = static_cast<std::size_t>(transfer.channels);
  std::vector<glm::vec3> lit((transfer.offsets.size() - 1) / channels);
  parallelRanges(lit.size(), vertexGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t row = v * channels + (channels == 1 ? 0 : c);
        const float* values = light.data() + c * texels;
        double sum = 0.0;
        for (std::uint32_t k = transfer.offsets[row]; k < transfer.offsets[row + 1]; ++k)
          sum += double(transfer.values[k]) * double(values[transfer.indices[k]]);
        lit[v][static_cast<int>(c)] = static_cast<float>(std::numbers::pi * sum);
      }
  });
  return lit;
}

std::vector<glm::vec3> irradiance(const LightGroupTransfer& transfer, std::span<const glm::vec3> colors) {
  const std::size_t groups = transfer.groups.size();
  if (colors.size() != groups)
    throw UsageError("colors",
                     fmt::format("got {}, expected one per group of lights: {}", colors.size(), groups));
  const auto channels = static_cast<std::size_t>(transfer.channels);
  std::vector<glm::vec3> lit(groups == 0 ? 0 : transfer.coefficients.size() / (channels * groups));
  for (std::size_t v = 0; v < lit.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const float* row = transfer.coefficients.data() + (v * channels + (channels == 1 ? 0 : c)) * groups;
      double sum = 0.0;
      for (std::size_t g = 0; g < groups; ++g) sum += double(row[g]) * double(colors[g][static_cast<int>(c)]);
      lit[v][static_cast<int>(c)] = static_cast<float>(std::numbers::pi * sum);
    }
  return lit;
}

}  // namespace prelight
