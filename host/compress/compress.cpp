#include "compress/compress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "compress/cluster_fit.h"
#include "compress/small_floats.h"
#include "prelight/error.h"
#include "prelight/transfer.h"

namespace prelight {

namespace {

double squaredError(const ByteRange& range, std::span<const double> values, std::span<const double> weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = range.decode(range.encode(values[i])) - values[i];
    sum += weights[i] * error * error;
  }
  return sum;
}

/// Returns the weighted least-squares fit of the values over the bytes that `range` gives them.
ByteRange regression(const ByteRange& range, std::span<const double> values,
                     std::span<const double> weights) {
  double w = 0.0, x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    w += weights[i];
    x += weights[i] * range.encode(values[i]);
    y += weights[i] * values[i];
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double dx = range.encode(values[i]) - x / w;
    xx += weights[i] * dx * dx;
    xy += weights[i] * dx * (values[i] - y / w);
  }
  if (!(w > 0.0) || !(xx > 0.0) || !(xy > 0.0)) return range;
  const double scale = xy / xx;
  return {static_cast<float>(y / w - scale * x / w), static_cast<float>(scale)};
}

}  // namespace

std::uint8_t ByteRange::encode(double value) const {
  if (!(scale > 0.0f)) return 0;
  const double byte = std::nearbyint((value - double(offset)) / double(scale));
  return static_cast<std::uint8_t>(std::clamp(byte, 0.0, 255.0));
}

ByteRange fitByteRange(std::span<const double> values, std::span<const double> weights) {
  if (values.empty()) return {};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  ByteRange best{static_cast<float>(*least), static_cast<float>((*greatest - *least) / 255.0)};
  double error = squaredError(best, values, weights);
  for (int turn = 0; turn < 12; ++turn) {
    const ByteRange next = regression(best, values, weights);
    const double nextError = squaredError(next, values, weights);
    if (!(nextError < error * (1.0 - 1e-4))) break;
    best = next;
    error = nextError;
  }
  return best;
}

namespace {

std::uint16_t saturatedHalf(double value) {
  return toHalf(std::clamp(static_cast<float>(value), -halfMax, halfMax));
}

std::size_t vertexCountOf(const HarmonicTransfer& transfer) {
  const auto dimension = static_cast<std::size_t>(transfer.channels * transfer.order * transfer.order);
  if (dimension == 0 || transfer.coefficients.size() % dimension != 0)
    throw InputError(
        "transfer",
        fmt::format("{} coefficients are not a whole number of vertices with {} channels and order {}",
                    transfer.coefficients.size(), transfer.channels, transfer.order));
  for (const float value : transfer.coefficients)
    if (!std::isfinite(value))
      throw InputError("transfer", "a coefficient is not finite, expected finite numbers", "bake again");
  return transfer.coefficients.size() / dimension;
}

/// Quantises per band and channel, whose coefficients vary least (Staniszewski 2005, 3.2).
void compressBands(const HarmonicTransfer& transfer, std::span<const double> vertexWeights,
                   CompressedTransfer& out) {
  const auto order = static_cast<std::size_t>(transfer.order), n = order * order;
  const auto channels = static_cast<std::size_t>(transfer.channels);
  out.bytes.resize(transfer.coefficients.size());
  out.ranges.resize(2 * channels * order);
  parallelRanges(channels * order, 1, [&](std::size_t group, std::size_t) {
    const std::size_t channel = group / order, band = group % order, width = 2 * band + 1;
    std::vector<double> values, weights;
    for (std::size_t v = 0; v < out.vertexCount; ++v) {
      const float* first = transfer.coefficients.data() + (v * channels + channel) * n + band * band;
      values.insert(values.end(), first, first + width);
      weights.insert(weights.end(), width, vertexWeights.empty() ? 1.0 : vertexWeights[v]);
    }
    const ByteRange range = fitByteRange(values, weights);
    out.ranges[2 * group] = range.offset;
    out.ranges[2 * group + 1] = range.scale;
    for (std::size_t v = 0; v < out.vertexCount; ++v)
      for (std::size_t i = 0; i < width; ++i)
        out.bytes[(v * channels + channel) * n + band * band + i] = range.encode(values[v * width + i]);
  });
}

/// Returns for each band the indices of its coefficients, of all channels, in a vertex's vector.
std::vector<std::vector<std::size_t>> placesOfBands(const CompressedTransfer& transfer) {
  const auto n = static_cast<std::size_t>(transfer.order * transfer.order);
  std::vector<std::vector<std::size_t>> places(static_cast<std::size_t>(transfer.order));
  for (std::size_t band = 0; band < places.size(); ++band)
    for (std::size_t c = 0; c < static_cast<std::size_t>(transfer.channels); ++c)
      for (std::size_t i = band * band; i < (band + 1) * (band + 1); ++i) places[band].push_back(c * n + i);
  return places;
}

/// Encodes with one exponent per band and vertex: these numbers are of similar size, and dark vertices keep
/// their precision beside bright ones.
void compressExponents(const HarmonicTransfer& transfer, CompressedTransfer& out) {
  const std::size_t d = out.dimension(), order = static_cast<std::size_t>(out.order);
  out.bytes.resize(transfer.coefficients.size());
  out.exponents.resize(out.vertexCount * order);
  const std::vector<std::vector<std::size_t>> places = placesOfBands(out);
  parallelRanges(out.vertexCount, 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<float> numbers;
    std::vector<std::uint8_t> mantissas;
    for (std::size_t v = begin; v < end; ++v)
      for (std::size_t band = 0; band < order; ++band) {
        numbers.clear();
        for (const std::size_t place : places[band]) numbers.push_back(transfer.coefficients[v * d + place]);
        mantissas.resize(numbers.size());
        out.exponents[v * order + band] = encodeSharedExponent(numbers, mantissas);
        for (std::size_t i = 0; i < numbers.size(); ++i) out.bytes[v * d + places[band][i]] = mantissas[i];
      }
  });
}

void storeByteWeights(const ClusterFit& fit, std::span<const double> vertexWeights, CompressedTransfer& out) {
  const auto k = static_cast<std::size_t>(fit.components), clusters = static_cast<std::size_t>(fit.clusters);
  std::vector<std::vector<std::size_t>> members(clusters);
  for (std::size_t v = 0; v < fit.clusterOf.size(); ++v) members[fit.clusterOf[v]].push_back(v);
  out.weightBytes.resize(fit.weights.size());
  out.weightRanges.resize(2 * clusters * k);
  for (std::size_t cluster = 0; cluster < clusters; ++cluster)
    for (std::size_t j = 0; j < k; ++j) {
      std::vector<double> values, weights;
      for (const std::size_t v : members[cluster]) {
        values.push_back(fit.weights[v * k + j]);
        weights.push_back(vertexWeights.empty() ? 1.0 : vertexWeights[v]);
      }
      const ByteRange range = fitByteRange(values, weights);
      out.weightRanges[2 * (cluster * k + j)] = range.offset;
      out.weightRanges[2 * (cluster * k + j) + 1] = range.scale;
      for (std::size_t i = 0; i < values.size(); ++i)
        out.weightBytes[members[cluster][i] * k + j] = range.encode(values[i]);
    }
}

/// Stores a fit in an output whose method and weights' storage are set.
void storeFit(const ClusterFit& fit, std::span<const double> vertexWeights, CompressedTransfer& out) {
  out.clusters = fit.clusters;
  out.components = fit.components;
  out.means.assign(fit.means.begin(), fit.means.end());
  out.basis.assign(fit.basis.begin(), fit.basis.end());
  if (out.method != CompressionMethod::Pca) out.clusterOf.assign(fit.clusterOf.begin(), fit.clusterOf.end());
  switch (out.weights) {
    case WeightStorage::Float:
      out.weightFloats.assign(fit.weights.begin(), fit.weights.end());
      break;
    case WeightStorage::Half:
      out.weightHalves.resize(fit.weights.size());
      std::transform(fit.weights.begin(), fit.weights.end(), out.weightHalves.begin(), saturatedHalf);
      break;
    case WeightStorage::Byte:
      storeByteWeights(fit, vertexWeights, out);
      break;
  }
}

void compressClusters(const HarmonicTransfer& transfer, const CompressionRequest& request,
                      std::span<const double> vertexWeights, const Progress& progress,
                      CompressedTransfer& out) {
  if (request.components < 0 || static_cast<std::size_t>(request.components) > out.dimension())
    throw UsageError("CompressionRequest::components",
                     fmt::format("got {} components, expected at most {}: a vertex has {} "
                                 "channels of {} coefficients",
                                 request.components, out.dimension(), out.channels, out.order * out.order));
  if (request.clusters < 1 || request.clusters > 65536)
    throw UsageError("CompressionRequest::clusters",
                     fmt::format("got {} clusters, expected 1 to 65536", request.clusters));
  if (out.vertexCount == 0) return;
  const ClusterRequest wanted{request.method == CompressionMethod::Pca ? 1 : request.clusters,
                              request.method == CompressionMethod::Vq ? 0 : request.components, request.seed,
                              request.iterations, &progress};
  out.weights = request.weights;
  storeFit(fitClusters(transfer.coefficients, out.dimension(), vertexWeights, wanted), vertexWeights, out);
}

/// Returns the least number of a fit's leading components whose weighted squared error, with weights of
/// bytes, is at most `most`, or nothing if any number leaves more. The components of a fit are orthonormal,
/// so that the errors of their weights add up.
std::optional<int> componentsWithin(const ClusterFit& fit, double most,
                                    std::span<const double> vertexWeights) {
  const auto all = static_cast<std::size_t>(fit.components);
  CompressedTransfer stored;
  stored.method = CompressionMethod::Pca;
  stored.weights = WeightStorage::Byte;
  stored.components = fit.components;
  storeByteWeights(fit, vertexWeights, stored);
  std::vector<double> variance(all, 0.0), rounding(all, 0.0);
  for (std::size_t v = 0; v < fit.clusterOf.size(); ++v)
    for (std::size_t j = 0; j < all; ++j) {
      const double mass = vertexWeights.empty() ? 1.0 : vertexWeights[v], weight = fit.weights[v * all + j];
      const double error = stored.weight(v, j) - weight;
      variance[j] += mass * weight * weight;
      rounding[j] += mass * error * error;
    }
  double error = fit.squaredErrors.back();
  for (const double dropped : variance) error += dropped;
  for (std::size_t kept = 0; kept <= all; ++kept) {
    if (error <= most) return static_cast<int>(kept);
    if (kept < all) error += rounding[kept] - variance[kept];
  }
  return std::nullopt;
}

/// Returns a fit of one cluster with its first components alone.
ClusterFit leading(const ClusterFit& fit, int components, std::size_t dimension) {
  const auto all = static_cast<std::size_t>(fit.components), few = static_cast<std::size_t>(components);
  ClusterFit out{fit.clusters, components, fit.means, {}, fit.clusterOf, {}, {}};
  out.basis.assign(fit.basis.begin(), fit.basis.begin() + static_cast<std::ptrdiff_t>(few * dimension));
  out.weights.reserve(fit.clusterOf.size() * few);
  for (std::size_t v = 0; v < fit.clusterOf.size(); ++v)
    for (std::size_t j = 0; j < few; ++j) out.weights.push_back(fit.weights[v * all + j]);
  return out;
}

/// Returns the weighted sum of squares of vectors, or of their differences from `others` if there are any.
double weightedSquares(std::span<const float> vectors, std::span<const float> others, std::size_t dimension,
                       std::span<const double> vertexWeights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const double value = double(vectors[i]) - (others.empty() ? 0.0 : double(others[i]));
    sum += (vertexWeights.empty() ? 1.0 : vertexWeights[i / dimension]) * value * value;
  }
  return sum;
}

void decompressVertex(const CompressedTransfer& compressed, std::size_t vertex, std::span<float> out) {
  const std::size_t d = compressed.dimension(), cluster = compressed.cluster(vertex);
  const auto k = static_cast<std::size_t>(compressed.components);
  std::vector<double> sum(d);
  for (std::size_t i = 0; i < d; ++i) sum[i] = compressed.means[cluster * d + i];
  for (std::size_t j = 0; j < k; ++j) {
    const double weight = compressed.weight(vertex, j);
    for (std::size_t i = 0; i < d; ++i) sum[i] += weight * compressed.basis[(cluster * k + j) * d + i];
  }
  for (std::size_t i = 0; i < d; ++i) out[i] = static_cast<float>(sum[i]);
}

/// Decodes a vertex; `places` is that of placesOfBands().
void decompressExponents(const CompressedTransfer& compressed,
                         const std::vector<std::vector<std::size_t>>& places, std::size_t vertex,
                         std::span<float> out) {
  const std::uint8_t* bytes = compressed.bytes.data() + vertex * out.size();
  const std::uint8_t* exponents = compressed.exponents.data() + vertex * places.size();
  for (std::size_t band = 0; band < places.size(); ++band)
    for (const std::size_t place : places[band])
      out[place] = decodeSharedExponent(exponents[band], bytes[place]);
}

void decompressBands(const CompressedTransfer& compressed, std::size_t vertex, std::span<float> out) {
  const auto order = static_cast<std::size_t>(compressed.order);
  const std::size_t d = compressed.dimension();
  std::size_t at = 0;
  for (std::size_t channel = 0; channel < static_cast<std::size_t>(compressed.channels); ++channel)
    for (std::size_t band = 0; band < order; ++band) {
      const std::size_t group = channel * order + band;
      const ByteRange range{compressed.ranges[2 * group], compressed.ranges[2 * group + 1]};
      for (std::size_t i = 0; i < 2 * band + 1; ++i, ++at)
        out[at] = static_cast<float>(range.decode(compressed.bytes[vertex * d + at]));
    }
}

}  // namespace

double CompressedTransfer::weight(std::size_t vertex, std::size_t component) const {
  const auto k = static_cast<std::size_t>(components);
  const std::size_t at = vertex * k + component;
  switch (weights) {
    case WeightStorage::Float:
      return weightFloats[at];
    case WeightStorage::Half:
      return fromHalf(weightHalves[at]);
    case WeightStorage::Byte: {
      const std::size_t range = 2 * (cluster(vertex) * k + component);
      return ByteRange{weightRanges[range], weightRanges[range + 1]}.decode(weightBytes[at]);
    }
  }
  return 0.0;
}

std::size_t CompressedTransfer::byteCount() const {
  const auto of = [](const auto& array) { return array.size() * sizeof(array[0]); };
  return of(halves) + of(bytes) + of(exponents) + of(ranges) + of(means) + of(basis) + of(clusterOf) +
         of(weightFloats) + of(weightHalves) + of(weightBytes) + of(weightRanges);
}

CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights) {
  return compress(transfer, request, vertexWeights, Progress());
}

CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights, const Progress& progress) {
  CompressedTransfer out;
  out.method = request.method;
  out.order = transfer.order;
  out.channels = transfer.channels;
  out.bounces = transfer.bounces;
  out.vertexCount = static_cast<std::uint32_t>(vertexCountOf(transfer));
  assert(vertexWeights.empty() || vertexWeights.size() == out.vertexCount);
  switch (request.method) {
    case CompressionMethod::Half:
      out.halves.resize(transfer.coefficients.size());
      std::transform(transfer.coefficients.begin(), transfer.coefficients.end(), out.halves.begin(),
                     [](float value) { return saturatedHalf(value); });
      break;
    case CompressionMethod::Band8:
      compressBands(transfer, vertexWeights, out);
      break;
    case CompressionMethod::Rgbe:
      compressExponents(transfer, out);
      break;
    case CompressionMethod::Pca:
    case CompressionMethod::Vq:
    case CompressionMethod::Cpca:
      compressClusters(transfer, request, vertexWeights, progress, out);
      break;
  }
  return out;
}

std::optional<BoundedCompression> compressToError(const HarmonicTransfer& transfer, double error,
                                                  int mostComponents, std::span<const double> vertexWeights,
                                                  const Progress& progress) {
  CompressedTransfer out;
  out.method = CompressionMethod::Pca;
  out.weights = WeightStorage::Byte;
  out.order = transfer.order;
  out.channels = transfer.channels;
  out.bounces = transfer.bounces;
  out.vertexCount = static_cast<std::uint32_t>(vertexCountOf(transfer));
  if (out.vertexCount == 0) return std::nullopt;
  const std::size_t d = out.dimension();
  const int most = static_cast<int>(std::min(static_cast<std::size_t>(mostComponents), d));
  const ClusterFit fit = fitClusters(transfer.coefficients, d, vertexWeights,
                                     {.clusters = 1, .components = most, .progress = &progress});
  const double squares = weightedSquares(transfer.coefficients, {}, d, vertexWeights);
  const std::optional<int> least = componentsWithin(fit, error * error * squares, vertexWeights);
  // Means and axes are rounded to floats, too, so that the stored form decides.
  for (int kept = least.value_or(most + 1); kept <= most; ++kept) {
    storeFit(leading(fit, kept, d), vertexWeights, out);
    const double squared =
        weightedSquares(transfer.coefficients, decompress(out).coefficients, d, vertexWeights);
    if (squared <= error * error * squares)
      return BoundedCompression{std::move(out), squares > 0.0 ? std::sqrt(squared / squares) : 0.0};
  }
  return std::nullopt;
}

HarmonicTransfer decompress(const CompressedTransfer& compressed) {
  HarmonicTransfer out{compressed.order, compressed.channels, compressed.bounces, {}};
  const std::size_t d = compressed.dimension();
  out.coefficients.resize(compressed.vertexCount * d);
  if (compressed.method == CompressionMethod::Half) {
    std::transform(compressed.halves.begin(), compressed.halves.end(), out.coefficients.begin(), fromHalf);
    return out;
  }
  const std::vector<std::vector<std::size_t>> places = placesOfBands(compressed);
  parallelRanges(compressed.vertexCount, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::span<float> vertex(out.coefficients.data() + v * d, d);
      if (compressed.method == CompressionMethod::Band8)
        decompressBands(compressed, v, vertex);
      else if (compressed.method == CompressionMethod::Rgbe)
        decompressExponents(compressed, places, v, vertex);
      else
        decompressVertex(compressed, v, vertex);
    }
  });
  return out;
}

}  // namespace prelight
