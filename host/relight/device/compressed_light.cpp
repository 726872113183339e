#include "relight/device/compressed_light.h"

#include <fmt/format.h>

#include "compress/small_floats.h"
#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns the band of a coefficient.
std::size_t bandOf(std::size_t i) {
  std::size_t band = 0;
  while ((band + 1) * (band + 1) <= i) ++band;
  return band;
}

void bandTerms(const CompressedTransfer& compressed, std::span<const double> light, CompressedLight& out) {
  const auto order = static_cast<std::size_t>(compressed.order), n = order * order;
  out.terms.assign(1 + n, glm::vec3(0.0f));
  for (int c = 0; c < 3; ++c) {
    const std::size_t channel = compressed.channels == 1 ? 0 : static_cast<std::size_t>(c);
    double constant = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t range = 2 * (channel * order + bandOf(i));
      const double coefficient = light[static_cast<std::size_t>(c) * n + i];
      constant += coefficient * double(compressed.ranges[range]);
      out.terms[1 + i][c] = static_cast<float>(coefficient * double(compressed.ranges[range + 1]));
    }
    out.terms[0][c] = static_cast<float>(constant);
  }
}

/// Returns the products of the light with one vector, [channel][i], for each colour.
glm::dvec3 productOf(std::span<const double> light, const float* vector, int channels) {
  const std::size_t n = light.size() / 3;
  glm::dvec3 sum(0.0);
  for (int c = 0; c < 3; ++c) {
    const float* own = vector + (channels == 1 ? 0 : static_cast<std::size_t>(c) * n);
    for (std::size_t i = 0; i < n; ++i) sum[c] += light[static_cast<std::size_t>(c) * n + i] * double(own[i]);
  }
  return sum;
}

void clusterTerms(const CompressedTransfer& compressed, std::span<const double> light, CompressedLight& out) {
  const std::size_t d = compressed.dimension();
  const auto k = static_cast<std::size_t>(compressed.components);
  for (std::size_t cluster = 0; cluster < static_cast<std::size_t>(compressed.clusters); ++cluster) {
    glm::dvec3 mean = productOf(light, compressed.means.data() + cluster * d, compressed.channels);
    const std::size_t first = out.terms.size();
    out.terms.resize(first + 1 + k);
    for (std::size_t j = 0; j < k; ++j) {
      const std::size_t at = cluster * k + j;
      glm::dvec3 product = productOf(light, compressed.basis.data() + at * d, compressed.channels);
      if (compressed.weights == WeightStorage::Byte) {
        mean += double(compressed.weightRanges[2 * at]) * product;
        product *= double(compressed.weightRanges[2 * at + 1]);
      }
      out.terms[first + 1 + j] = glm::vec3(product);
    }
    out.terms[first] = glm::vec3(mean);
  }
}

/// Returns the stored number of a weight, which the terms expect.
double storedWeight(const CompressedTransfer& compressed, std::size_t at) {
  switch (compressed.weights) {
    case WeightStorage::Float:
      return compressed.weightFloats[at];
    case WeightStorage::Half:
      return fromHalf(compressed.weightHalves[at]);
    case WeightStorage::Byte:
      return compressed.weightBytes[at];
  }
  return 0.0;
}

/// Returns the stored number of a coefficient, which the terms expect.
double storedCoefficient(const CompressedTransfer& compressed, std::size_t vertex, std::size_t at,
                         std::size_t i) {
  switch (compressed.method) {
    case CompressionMethod::Band8:
      return compressed.bytes[at];
    case CompressionMethod::Rgbe:
      return decodeSharedExponent(
          compressed.exponents[vertex * static_cast<std::size_t>(compressed.order) + bandOf(i)],
          compressed.bytes[at]);
    default:
      return fromHalf(compressed.halves[at]);
  }
}

glm::dvec3 relightClustered(const CompressedTransfer& compressed, const CompressedLight& light,
                            std::size_t vertex) {
  const auto k = static_cast<std::size_t>(compressed.components);
  const glm::vec3* terms = light.terms.data() + compressed.cluster(vertex) * (1 + k);
  glm::dvec3 sum(terms[0]);
  for (std::size_t j = 0; j < k; ++j)
    sum += glm::dvec3(terms[1 + j]) * storedWeight(compressed, vertex * k + j);
  return sum;
}

glm::dvec3 relightStored(const CompressedTransfer& compressed, const CompressedLight& light,
                         std::size_t vertex) {
  const auto n = static_cast<std::size_t>(compressed.order * compressed.order);
  const bool bytes = compressed.method == CompressionMethod::Band8;
  const glm::vec3* terms = light.terms.data() + (bytes ? 1 : 0);
  glm::dvec3 sum = bytes ? glm::dvec3(light.terms[0]) : glm::dvec3(0.0);
  for (int c = 0; c < 3; ++c) {
    const std::size_t first =
        vertex * compressed.dimension() + (compressed.channels == 1 ? 0 : static_cast<std::size_t>(c) * n);
    for (std::size_t i = 0; i < n; ++i)
      sum[c] += double(terms[i][c]) * storedCoefficient(compressed, vertex, first + i, i);
  }
  return sum;
}

}  // namespace

CompressedLight lightOf(const CompressedTransfer& compressed, std::span<const double> light) {
  const auto n = static_cast<std::size_t>(compressed.order * compressed.order);
  if (light.size() != 3 * n)
    throw UsageError("light", fmt::format("got {} coefficients, expected 3 x {} for transfer of order {}",
                                          light.size(), n, compressed.order));
  CompressedLight out;
  switch (compressed.method) {
    case CompressionMethod::Half:
    case CompressionMethod::Rgbe:
      for (std::size_t i = 0; i < n; ++i) out.terms.emplace_back(light[i], light[n + i], light[2 * n + i]);
      break;
    case CompressionMethod::Band8:
      bandTerms(compressed, light, out);
      break;
    case CompressionMethod::Pca:
    case CompressionMethod::Vq:
    case CompressionMethod::Cpca:
      clusterTerms(compressed, light, out);
      break;
  }
  return out;
}

std::vector<glm::dvec3> relight(const CompressedTransfer& compressed, const CompressedLight& light) {
  const bool stored = compressed.clusters == 0;
  std::vector<glm::dvec3> out(compressed.vertexCount);
  for (std::size_t v = 0; v < out.size(); ++v)
    out[v] = stored ? relightStored(compressed, light, v) : relightClustered(compressed, light, v);
  return out;
}

}  // namespace prelight
